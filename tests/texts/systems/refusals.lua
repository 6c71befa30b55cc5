-- System files with mistakes: the messages, and where they point.

--- The message about a missing or wrong field lists every value that is allowed.
arena { size = { 2, 2 }, cylinder { at = { 1, 1 }, radius = 0.1 } }
-- error: cylinder: field 'height' is missing: expected a positive number in m

arena { size = { 2, 2 }, border = 5 }
--                       ^ error: arena: field 'border' expected true, false or { thickness =, height = }, got number

--- The message about an unknown field gives its place and the nearest known field.
robot 'm' {
  modell = 'raspimouse' }
--^ error: robot 'm': unknown field 'modell' (did you mean 'model'?)

robot 'm' { model = 'raspimouse',
  pose = {
 x = 1,
 heding = 2 } }  -- error at column 2: robot 'm': unknown field 'pose.heding' (did you mean 'heading'?)

robot('m', { model = 'raspimouse', limits = { sped = 2 } })
--                                            ^ error: robot 'm': unknown field 'limits.sped' (did you mean 'speed'?)

robot 'e' { model = 'ev3', config = { medium_motor_speed = 2 } }
--                         ^ error: robot 'e': unknown field 'config': write fields of its description, as in actuators = { medium_motor = { speed = 2 } }

behavior 'c' { script = 'robot_controller', speed_x = 1 }
--                                          ^ error: behavior 'c': unknown field 'speed_x': expected script, config, sets, set, rate, active

behavior 'c' { 'robot_controller' }
--             ^ error: behavior 'c': unknown field '[1]': expected script, config, sets, set, rate, active

component 'c' { typ = 'Camera' }
--              ^ error: component 'c': unknown field 'typ' (did you mean 'type'?)

arena {
 box { at = { 1, 0, 0 }, sise = { 1, 1, 1 } } }
--                       ^ error: box: unknown field 'sise' (did you mean 'size'?)

arena { siz = { 1, 1 } }
--      ^ error: arena: unknown field 'siz' (did you mean 'size'?)

arena { box = { at = { 0, 0 }, size = { 1, 1, 1 } } }
--      ^ error: arena: unknown field 'box': write box { ... }, without =

arena { csv = 'map.csv' }
--      ^ error: arena: unknown field 'csv': write csv "map.csv", without =

--- The message about a value of the wrong type names its field.
robot 'm' { model = 5 }
--          ^ error: robot 'm': field 'model' expected a string, got number

robot 'm' { model = 'raspimouse', pose = { x = '1' } }
--                                         ^ error: robot 'm': field 'pose.x' expected a number, got string

robot 'm' { model = 'raspimouse', pose = { heading = 0/0 } }
--                                         ^ error: robot 'm': field 'pose.heading' expected a finite number, got nan

robot 'm' { model = 'raspimouse', pose = { y = math.huge } }
--                                         ^ error: robot 'm': field 'pose.y' expected a finite number, got inf

robot 'm' { model = 'raspimouse', pose = 3 }
--                                ^ error: robot 'm': field 'pose' expected a table, got number

robot 'm' { model = 'raspimouse', limits = { speed = 0 } }
--                                           ^ error: robot 'm': field 'limits.speed' expected a positive number, got 0

robot 'm' { model = 'raspimouse', active = 1 }
--                                ^ error: robot 'm': field 'active' expected true or false, got number

behavior 'c' { script = 'robot_controller', config = { speed_x = print } }
--                                                     ^ error: behavior 'c': field 'config.speed_x' expected a number, a boolean, a string or an array of them, got function

behavior 'c' { script = 'robot_controller', config = { a = { 1, 'x' } } }
--                                                     ^ error: behavior 'c': field 'config.a' expected an array of numbers, of booleans or of strings

behavior 'c' { script = 'robot_controller', config = { a = { b = 1 } } }
--                                                     ^ error: behavior 'c': field 'config.a' expected an array, got a table with a field 'b'

behavior 'c' { script = 'robot_controller', config = { a = -math.huge } }
--                                                     ^ error: behavior 'c': field 'config.a' expected a finite number, got -inf

robot 'm' 'raspimouse'  -- error: robot 'm': expected a table, got string

--- The message about a missing field says what is expected.
robot 'm' {}  -- error: robot 'm': field 'model' is missing: expected a string: a robot's file, for example "raspimouse"

behavior 'c' {}
-- error: behavior 'c': field 'script' is missing: expected a string: a behaviour's file, for example "robot_controller"

component 'c' {}
-- error: component 'c': field 'type' is missing: expected a string: a native component's type, for example "Camera"

arena { box { size = { 1, 1, 1 } } }
-- error: box: field 'at' is missing: expected { x, y, z } in m: centre; without z it stands on the floor

arena { marker { at = { 1, 1, 1 } } }
-- error: marker: field 'id' is missing: expected a whole number from 0 to 586: the tag's number

--- A maze must be inside the arena.
arena { size = { 1, 1 }, maze { generate = { columns = 4, rows = 2 } } }
-- error: maze: it reaches from { -0.096, -0.096 } to { 0.636, 0.276 }, out of the arena of 1 x 1 m: move it by 'at', or make the arena larger

arena { size = { 0.72, 0.36 }, maze { generate = { columns = 4, rows = 2 }, at = { -0.27, -0.09 } } }

arena { maze { generate = { columns = 4, rows = 2 } } }

--- Objects of an arena must have valid sizes and positions.
arena { box { at = { 0, 0, 0 }, size = { 1, 0, 1 } } }
--                                          ^ error: box: field 'size[2]' expected a positive number, got 0

arena { box { at = { 0, 0, 0 }, size = { 1, 1 } } }
--                              ^ error: box: field 'size' expected 3 numbers { x, y, z }, got 2

arena { box { at = { 0, 0, 0 }, size = { 1, 1, 1e-7 } } }
--                              ^ error: box: field 'size' expected lengths of at least 0.0001 m

arena { box { at = { 0, 0, 1e9 }, size = { 1, 1, 1 } } }
--                         ^ error: box: field 'at[3]' expected a number up to 1000000, got 1000000000

arena { box { at = { 0, 0, 1, 2 }, size = { 1, 1, 1 } } }
--            ^ error: box: field 'at' expected 3 numbers { x, y, z }, got 4

arena { box { at = { x = 0, y = 0, w = 1 }, size = { 1, 1, 1 } } }
--                                 ^ error: box: unknown field 'at.w': expected { x, y, z }

arena { box { at = 'here', size = { 1, 1, 1 } } }
--            ^ error: box: field 'at' expected { x, y, z }, got string

arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, mass = -1 } }
--                                               ^ error: box: field 'mass' expected a number from 0 on, got -1

arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, color = 'yelow' } }
--                                               ^ error: box: field 'color' expected "#rrggbb" or the name of a colour, got 'yelow' (did you mean 'yellow'?)

arena { box { at = { 0, 0 }, size = { 1, 1, 1 }, mass = 1, pitch = 0.1 } }
--                                                         ^ error: box: field 'pitch' can be used only for a box without mass: a movable box stands level

arena { wall { from = { 1, 1 }, to = { 1, 1 } } }
--                              ^ error: wall: 'from' and 'to' are the same place: expected a wall with a length

arena { wall { from = { 1, 1, 0 }, to = { 1, 1 } } }
--             ^ error: wall: field 'from' expected 2 numbers { x, y }, got 3

arena { cylinder { at = { 0, 0 }, radius = -1, height = 1 } }
--                                ^ error: cylinder: field 'radius' expected a positive number, got -1

arena { maze {} }  -- error: maze: field 'rows' is missing: expected a drawing, or generate = { columns =, rows =, seed = }; or write maze "FILE"

arena { maze { rows = 'x' } }
--             ^ error: maze: field 'rows' expected a list of strings, got string

arena { maze { rows = { '+--+', 5 } } }
--                              ^ error: maze: field 'rows[2]' expected a string, got number

arena { maze { rows = { '+--+', '|  |' } } }
--             ^ error: maze: field 'rows' expected 2 rows for each cell and one more, for 1 to 64 cells, got 2 rows

arena { maze { rows = { '+--+', '|  |', '+-++' } } }
--                                      ^ error: maze: field 'rows[3]' expected "--" or blanks from character 2 on, got "-+"

arena { maze { rows = { '+--+', '|  |', '+--+' }, generate = {} } }
--                                                ^ error: maze: field 'generate' can be used only in a maze without 'rows'

arena { maze { generate = { columns = 65 } } }
--                          ^ error: maze: field 'generate.columns' expected a whole number from 1 to 64, got 65

arena { maze { generate = {}, cell = 0.01 } }
--                            ^ error: maze: field 'cell' expected at least 0.024 m, twice the walls' thickness, got 0.01

arena { maze { generate = {}, thickness = 0.1 } }
-- error: maze: field 'cell' expected at least 0.2 m, twice the walls' thickness, got 0.18

arena { maze { 'mazes/first.txt', rows = {} } }
--                                ^ error: maze: field 'rows' can be used only in a maze without a file

arena { maze { 'mazes/first.txt', generate = {} } }
--                                ^ error: maze: field 'generate' can be used only in a maze without a file

arena { maze(5) }
-- error: maze: expected a table, got number

arena { marker { id = 587, at = { 0, 0, 0 } } }
--               ^ error: marker: field 'id' expected a whole number from 0 to 586, got 587

arena { marker { id = 1, name = 'end', at = { 0, 0, 0 } } }
--                       ^ error: marker: field 'name' expected letters, digits and _, not beginning with a digit, and no keyword of Lua, got 'end'

arena { marker { id = 1.5, at = { 0, 0, 0 } } }
--               ^ error: marker: field 'id' expected a whole number from 0 to 586, got 1.5

arena { size = { 1, -1 } }
--                  ^ error: arena: field 'size[2]' expected a positive number, got -1

arena { size = 4 }
--      ^ error: arena: field 'size' expected { x, y }, got number

arena 'big'  -- error: arena: expected a table, got string

--- Every object must be in the arena exactly once.
box { at = { 0, 0 }, size = { 1, 1, 1 } }  -- error: box: it is not in the arena: write arena { box ... }

local b = box { at = { 0, 0 }, size = { 1, 1, 1 } }
arena { b }
arena { b }  -- error: arena: the box at system.lua:1 is in the arena already

arena { 5 }  -- error: arena: element 1: expected a box, wall, cylinder, marker, maze, floor, line, csv or map, got a number

arena { { at = { 0, 0 } } }
-- error: arena: element 1: expected a box, wall, cylinder, marker, maze, floor, line, csv or map, got a table

arena { size = { 1, 1 } }
arena { size = { 1, 1 } }
--      ^ error: arena: field 'size' is set already, at system.lua:1

arena { marker { name = 'c', id = 1, at = { 0, 0, 0 } } }  -- error: marker 'c': the name is already used by the behavior at system.lua:2
behavior 'c' { script = 'robot_controller' }

arena { marker { id = 1, at = { 0, 0, 0 } },
 marker { id = 1, at = { 1, 0, 0 } } }  -- error: marker: the name 'marker_1' is already used by the marker at system.lua:1

--- The message about an unknown model or script gives the nearest name and the places that were searched.
robot 'm' { model = 'raspimous' }
--          ^ error: robot 'm': there is no robot model 'raspimous' (did you mean 'raspimouse'?); looked for raspimous.lua, engine/robots/raspimous.lua, behaviors/raspimous.lua

behavior 'c' {
  script = 'robot_controler' }
--^ error: behavior 'c': there is no script 'robot_controler' (did you mean 'robot_controller'?); looked for robot_controler.lua, behaviors/robot_controler.lua

arena { csv 'no.csv' }  -- error: csv: there is no file 'no.csv'; looked for no.csv, engine/robots/no.csv, behaviors/no.csv

arena { floor { image = 'no.png', size = { 1, 1 } } }
--              ^ error: floor: there is no file 'no.png'; looked for no.png, engine/robots/no.png, behaviors/no.png

arena { floor { size = { 1, 1 } } }
-- error: floor: field 'image' is missing: expected a string: a picture (PNG, JPEG, BMP, TIFF, PPM, WebP ...); its upper edge lies towards positive y, its right one towards positive x

--- A name must be an identifier that is not used.
robot 'm' { model = 'raspimouse' }
behavior 'm' { script = 'robot_controller' }  -- error: behavior 'm': the name is already used by the robot at system.lua:1

robot 'my mouse' { model = 'raspimouse' }
-- error: robot 'my mouse': a name consists of letters, digits and _, and does not begin with a digit

robot '1st' {}  -- error: robot '1st': a name consists of letters, digits and _, and does not begin with a digit

robot '' {}  -- error: robot '': a name consists of letters, digits and _, and does not begin with a digit

behavior 'step' {}  -- error: behavior 'step': 'step' is a keyword of Lua or a command of the console: choose another name

behavior 'end' {}  -- error: behavior 'end': 'end' is a keyword of Lua or a command of the console: choose another name

robot { model = 'raspimouse' }  -- error: robot: expected a name, got table: write robot "NAME" { ... }

-- a name alone
robot 'm'  -- error: robot 'm': expected a table after the name: robot "m" { ... }

robot('m', {}, 3)  -- error: robot: expected at most 2 arguments, got 3: robot "NAME" { ... }

--- The parameter set in use must be one of the sets.
behavior 'c' { script = 'robot_controller', sets = { careful = {} }, set = 'carefull' }
--                                                                   ^ error: behavior 'c': field 'set': there is no set 'carefull' in 'sets' (did you mean 'careful'?)

behavior 'c' { script = 'robot_controller', sets = { default = {} } }
--                                                   ^ error: behavior 'c': field 'sets.default': the name "default" means that no set is in use: choose another name

behavior 'c' { script = 'robot_controller', sets = { [''] = {} } }
--                                                    ^ error: behavior 'c': field 'sets.': a set needs a name

behavior 'c' { script = 'robot_controller', set = 'fast' }
--                                          ^ error: behavior 'c': field 'set': there is no set 'fast' in 'sets'

behavior 'c' { script = 'robot_controller', sets = { careful = 3 } }
--                                                   ^ error: behavior 'c': field 'sets.careful' expected a table, got number

behavior 'c' { script = 'robot_controller', sets = { careful = { x = {{}} } } }
--                                                               ^ error: behavior 'c': field 'sets.careful.x' expected an array of numbers, of booleans or of strings

--- A component must be on a robot of the system.
robot 'mouse' { model = 'raspimouse' }
component 'eye' { type = 'Camera', on = 'mous' }
-- error: component 'eye': field 'on': there is no robot 'mous' (did you mean 'mouse'?)

--- Unknown globals are refused before the file runs.
connect('a.x', 'b.y')
if false then
  robott 'm' {}
--^ error: unknown global 'robott' (did you mean 'robot'?)
end

robott 'm' {}  -- error at column 1: unknown global 'robott' (did you mean 'robot'?)

count = 3  -- error at column 1: unknown global 'count' (declare it first: local count)

io.open('x')  -- error at column 1: unknown global 'io'

os.exit(1)  -- error at column 1: unknown global 'os' (did you mean 'ros'?)

robot = nil
-- error at column 1: 'robot' can't be assigned: it is predefined (write 'local robot' for a variable of that name)

--- A message is one short line, also if the file contains long texts or control characters.
error('a\nb\27[2J\0')  -- error: a b?[2J?

robot('a\nb', {})  -- error: robot 'a b': a name consists of letters, digits and _, and does not begin with a digit

behavior('c', { script = ('x'):rep(100000) })
--              ^ error: behavior 'c': there is no script 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...

component('c', { type = 'Camera', on = 'a\1' })  -- error: component 'c': field 'on': there is no robot 'a?'

local xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx = = 1
-- error: unexpected symbol near '='

--- A zero byte does not end a name in a system file.
robot('m\0x', { model = 'raspimouse' })
-- error: robot 'm?x': a name consists of letters, digits and _, and does not begin with a digit

robot('m', { model = 'raspimouse\0x' })
--           ^ error: robot 'm': the name of a robot model has a control character in it: 'raspimouse\x00x'

behavior('c', { script = 'robot_controller\0x' })
--              ^ error: behavior 'c': the name of a script has a control character in it: 'robot_controller\x00x'

robot 'm' { model = 'raspimouse' } connect('m\0x.ir_sensor_out', 'm.target_velocity_in')
-- error: connect: expected "name.port", got 'm?x.ir_sensor_out'

arena { csv 'map.csv\0x' }  -- error: csv: the name of a file has a control character in it: 'map.csv\x00x'

robot 'm' { model = 'raspimouse' } error('a\0b')  -- error: a?b

--- A file name never opens a device.
arena { csv '/dev/zero' }
-- error: csv: there is no file '/dev/zero'; looked for /dev/zero; /dev/zero is a device, expected a file

--- An error in a system file counts although the file catches it with pcall.
pcall(rate, -1)  -- error: rate: expected a positive number of ticks per second, got -1
rate(50)

--- Exports to RTCs are declared once, with names that exist.
behavior 'c' { script = 'robot_controller' }
rtm { exports = 'c' }
--    ^ error: rtm: unknown field 'exports' (did you mean 'export'?)

behavior 'c' { script = 'robot_controller' }
rtm { export = 5 }
--    ^ error: rtm: field 'export' expected a name or a list of names, got number

behavior 'c' { script = 'robot_controller' }
rtm { export = { 'c', 'cc' } }  -- error: rtm: field 'export': there is no component 'cc' (did you mean 'c'?)

behavior 'c' { script = 'robot_controller' }
rtm { export = { 'c', 'c' } }
--    ^ error: rtm: field 'export' has 'c' twice

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
rtm {}  -- error: rtm: is set already, at system.lua:2

behavior 'c' { script = 'robot_controller' }
rtm { nameserver = 'localhost:0' }
--    ^ error: rtm: field 'nameserver' expected "HOST:PORT", got 'localhost:0'

behavior 'c' { script = 'robot_controller' }
rtm { nameserver = 'corbaloc::localhost' }
--    ^ error: rtm: field 'nameserver' expected "HOST:PORT", got 'corbaloc::localhost'

behavior 'c' { script = 'robot_controller' }
rtm { interface = 'eth0' }
--    ^ error: rtm: field 'interface' expected an address such as 192.168.1.10, got 'eth0'

behavior 'c' { script = 'robot_controller' }
rtm { interface = '1.2.3.256' }
--    ^ error: rtm: field 'interface' expected an address such as 192.168.1.10, got '1.2.3.256'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c', rename = { ['d.in'] = 'x' } }
--                              ^ error: rtm: field 'rename' gives 'd.in' another name: expected "name.port" of a component that is exported

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c', rename = { ['c.in'] = 'a b' } }
--                              ^ error: rtm: field 'rename' gives 'c.in' another name: 'a b' is not the name of a port

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c', rename = { ['c.in'] = 5 } }
--                              ^ error: rtm: field 'rename' gives 'c.in' another name: expected a port's name as a string, got 5

--- One end of a connection may be a port of another program if the other end is exported.
behavior 'c' { script = 'robot_controller' }
connect('rtm:Out0.out', 'c.in')
-- error: connect: rtm:Out0.out is a port of another program, which sees only exported components: write rtm { export = { "c" } }

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:Out0.out', 'cc.in')  -- error: connect: there is no component 'cc' (did you mean 'c'?)

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:Out0.out', 'rtm:In0.in')
-- error: connect: both ends are ports of other programs: one of them must be of this system

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:', 'c.in')  -- error: connect: expected "rtm:NAME.port" or "rtm:HOST.host_cxt/NAME.port", got 'rtm:'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:out', 'c.in')  -- error: connect: expected "rtm:NAME.port" or "rtm:HOST.host_cxt/NAME.port", got 'rtm:out'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:.out', 'c.in')  -- error: connect: expected "rtm:NAME.port" or "rtm:HOST.host_cxt/NAME.port", got 'rtm:.out'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:Out0.', 'c.in')  -- error: connect: expected "rtm:NAME.port" or "rtm:HOST.host_cxt/NAME.port", got 'rtm:Out0.'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:/Out0.out', 'c.in')
-- error: connect: expected "rtm:NAME.port" or "rtm:HOST.host_cxt/NAME.port", got 'rtm:/Out0.out'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:a//b.out', 'c.in')  -- error: connect: expected "rtm:NAME.port" or "rtm:HOST.host_cxt/NAME.port", got 'rtm:a//b.out'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:a.b/c', 'c.in')  -- error: connect: expected "rtm:NAME.port" or "rtm:HOST.host_cxt/NAME.port", got 'rtm:a.b/c'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:Out 0.out', 'c.in')
-- error: connect: expected "rtm:NAME.port" or "rtm:HOST.host_cxt/NAME.port", got 'rtm:Out 0.out'

behavior 'c' { script = 'robot_controller' }
rtm { export = 'c' }
connect('rtm:Out0.out', 'c.in')
connect('rtm:Out0.out', 'c.in')  -- error: connect: rtm:Out0.out is connected to c.in already, at system.lua:3

--- Seed, rate and physics step are set once, to valid numbers.
seed(42) rate(50) physics { step = 0.01 }

seed(1)
seed(1)  -- error: seed: is set already, at system.lua:1

rate(50)
rate(50)  -- error: rate: is set already, at system.lua:1

physics { step = 0.01 }
physics { step = 0.01 }  -- error: physics: is set already, at system.lua:1

seed(-1)  -- error: seed: expected a whole number from 0 on, got -1

seed(1.5)  -- error: seed: expected a whole number from 0 on, got 1.5

seed(1e3)

seed(2^62)

seed 'x'  -- error: seed: expected a whole number from 0 on, got string

rate(0)  -- error: rate: expected a positive number of ticks per second, got 0

rate(0/0)  -- error: rate: expected a positive number of ticks per second, got nan

rate {}  -- error: rate: expected a positive number of ticks per second, got table

rate()  -- error: rate: expected an argument, got none

physics { step = -1 }
--        ^ error: physics: field 'step' expected a positive number, got -1

physics { stepp = 1 }
--        ^ error: physics: unknown field 'stepp' (did you mean 'step'?)

physics { step = 1e-300 } rate(1e300)
--        ^ error: physics: field 'step' expected at least 1e-06 s, got 1e-300

behavior 'b' { script = 'robot_controller', rate = 1e-7 }
--                                          ^ error: behavior 'b': field 'rate' expected at least 1e-06 Hz, got 1e-07

physics {}
-- error: physics: field 'step' is missing: expected a positive number in s: duration of a physics step; a tick is a whole number of them

--- A tick must be a whole number of physics steps.
-- tick
rate(60)
-- error: rate: a tick of 60 Hz is not a whole number of physics steps of 0.005 s; the nearest rates are 50 or 66.66666666666667 Hz

physics { step = 0.003 }
-- error: rate: a tick of 100 Hz is not a whole number of physics steps of 0.003 s; the nearest rates are 83.33333333333333 or 111.1111111111111 Hz

rate(200)

--- The rate of a component must not be above the rate of the tick.
behavior 'c' { script = 'robot_controller',
 rate = 200 }
-- error at column 2: behavior 'c': a rate of 200 Hz is above the tick's 100 Hz: lower it, or raise the tick with rate(...)

component 'c' { type = 'Joystick', rate = 101 }
--                                 ^ error: component 'c': a rate of 101 Hz is above the tick's 100 Hz: lower it, or raise the tick with rate(...)

behavior 'c' { script = 'robot_controller', rate = 200 } rate(200)

behavior 'c' { script = 'robot_controller', rate = 0 }
--                                          ^ error: behavior 'c': field 'rate' expected a positive number, got 0

--- A connection names two ports, and is made once.
connect('mouse', 'controller.in')  -- error: connect: expected "name.port", got 'mouse'

connect('mouse.a', 'controller.in.x')  -- error: connect: expected "name.port", got 'controller.in.x'

connect('mouse.', 'controller.in')  -- error: connect: expected "name.port", got 'mouse.'

connect('mouse.a')  -- error: connect: expected "name.port", got nil

connect(1, 2)  -- error: connect: expected "name.port", got number

connect()  -- error: connect: expected "name.port", got nil

connect('a.x', 'b.in')
connect('a.x', 'b.in')  -- error: connect: a.x is connected to b.in already, at system.lua:1

connect('a.x', 'b.in') connect('a.x', 'c.in')

--- A line needs points and a floor.
arena { size = { 2, 2 }, line { width = 0.1 } }  -- error: line: field 'points' is missing: expected { { x, y }, ... } in m

arena { size = { 2, 2 }, line { points = { { 0, 0 } } } }
--                              ^ error: line: field 'points' expected two points or more, got 1

arena { size = { 2, 2 }, line { points = { { 0, 0 }, { 1 } } } }
--                                                   ^ error: line: field 'points[2]' expected { x, y }, two numbers in m

arena { size = { 2, 2 }, line { points = { { 0, 0 }, { 0, 1 } }, width = 0 } }
--                                                               ^ error: line: field 'width' expected a positive number, got 0

arena { size = { 2, 2 }, line { points = { { 0, 0 }, { 0, 1.1 } } } }
-- error: line: the point { 0, 1.1 } lies outside of the arena, 2 x 2 m

arena { line { points = { { 0, 0 }, { 0, 1 } } } }
-- error: line: there is no floor to paint it on: give the arena a size or a floor

--- An argument is declared once.
argument("n", 5)
argument("n", "x")  -- error: argument 'n': is declared already, at system.lua:1

for _ = 1, 2 do argument("n", 5) end  -- error: argument 'n': is declared already, at system.lua:1
