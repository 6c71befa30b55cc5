-- Functions of system files refuse wrong numbers and types of arguments.

--- Every function of system files refuses too many arguments and arguments of a wrong type.
arena({}, 2)  -- error: arena: expected at most 1 argument, got 2: arena { ... }

arena 'x'  -- error: arena: expected a table, got string

behavior('a', {}, 3)  -- error: behavior: expected at most 2 arguments, got 3: behavior "NAME" { ... }

behavior(5)  -- error: behavior: expected a name, got number: write behavior "NAME" { ... }

box({}, 2)  -- error: box: expected at most 1 argument, got 2: box { ... }

box 'x'  -- error: box: expected a table, got string

component('a', {}, 3)  -- error: component: expected at most 2 arguments, got 3: component "NAME" { ... }

component(5)  -- error: component: expected a name, got number: write component "NAME" { ... }

connect('a.b', 'c.d', 3)  -- error: connect: expected at most 2 arguments, got 3: connect(from, to)

connect('a.b', 5)  -- error: connect: expected "name.port", got number

csv('a.csv', 2)  -- error: csv: expected at most 1 argument, got 2: csv "FILE"

csv(5)  -- error: csv: expected a file's name, got number

cylinder({}, 2)  -- error: cylinder: expected at most 1 argument, got 2: cylinder { ... }

cylinder 'x'  -- error: cylinder: expected a table, got string

floor({}, 2)  -- error: floor: expected at most 1 argument, got 2: floor { ... }

floor 'x'  -- error: floor: expected a table, got string

line({}, 2)  -- error: line: expected at most 1 argument, got 2: line { ... }

line 'x'  -- error: line: expected a table, got string

map('a.yaml', 2)  -- error: map: expected at most 1 argument, got 2: map "FILE"

map(5)  -- error: map: expected a file's name, got number

marker({}, 2)  -- error: marker: expected at most 1 argument, got 2: marker { ... }

marker 'x'  -- error: marker: expected a table, got string

maze({}, 2)  -- error: maze: expected at most 1 argument, got 2: maze { ... }

maze 'x'  -- error: maze: expected a table, got string

network({}, 2)  -- error: network: expected at most 1 argument, got 2: network { ... }

network 'x'  -- error: network: expected a table, got string

physics({}, 2)  -- error: physics: expected at most 1 argument, got 2: physics { ... }

physics 'x'  -- error: physics: expected a table, got string

rate(100, 2)  -- error: rate: expected at most 1 argument, got 2: rate(hertz)

rate 'x'  -- error: rate: expected a positive number of ticks a second, got string

robot('a', {}, 3)  -- error: robot: expected at most 2 arguments, got 3: robot "NAME" { ... }

robot(5)  -- error: robot: expected a name, got number: write robot "NAME" { ... }

ros({}, 2)  -- error: ros: expected at most 1 argument, got 2: ros { ... }

ros 'x'  -- error: ros: expected a table, got string

rtm({}, 2)  -- error: rtm: expected at most 1 argument, got 2: rtm { ... }

rtm 'x'  -- error: rtm: expected a table, got string

seed(1, 2)  -- error: seed: expected at most 1 argument, got 2: seed(number)

seed 'x'  -- error: seed: expected a whole number from 0 on, got string

wall({}, 2)  -- error: wall: expected at most 1 argument, got 2: wall { ... }

wall 'x'  -- error: wall: expected a table, got string

robot 'm' ({ model = 'raspimouse' }, 2)  -- error: robot 'm': expected at most 1 argument, got 2: robot 'm' { ... }

require('a', 2)  -- error: require: expected at most 1 argument, got 2: require(name)
