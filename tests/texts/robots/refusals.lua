-- Robot files with mistakes: the messages, and where they point.

--- The message about an unknown field of a robot gives its place and the nearest known field.
maas = 1  -- error at column 1: robot_model: unknown field 'maas' (did you mean 'mass'?)

return robot_model { mass = 1, body = { size = { 1, 1, 1 },
 shap = 'box' }, drive = { radius = 1, track = 1 } }
-- error at column 2: robot_model: unknown field 'body.shap' (did you mean 'shape'?)

sensors = { front = {
 kind = 'range', yow = 1 } }
--               ^ error: robot_model: unknown field 'sensors.front.yow' (did you mean 'yaw'?)

sensors = { front = { kind = 'button', range = 1 } }
--                                     ^ error: robot_model: unknown field 'sensors.front.range': expected kind, at, yaw, on, port

sensors = { { kind = 'range' } }
--          ^ error: robot_model: unknown field 'sensors[1]': expected NAME = { ... }

ports = { p = { type = 'TimedPose2D', form = 'odometry' } }
--                                    ^ error: robot_model: unknown field 'ports.p.form' (did you mean 'from'?)

ports = { p = { type = 'TimedPose2D', from = 'odometry', queue = 3 } }
--                                                       ^ error: robot_model: unknown field 'ports.p.queue': expected type, from, doc, rate, quantity

--- The message says what is wrong with a sensor of neighbours and with its ports.
sensors = { near = { kind = 'neighbours', radus = 1 } }
--                                        ^ error: robot_model: unknown field 'sensors.near.radus' (did you mean 'radius'?)

sensors = { near = { kind = 'neighbours', loss = 2 } }
--                                        ^ error: robot_model: field 'sensors.near.loss' expected a number from 0 to 1, got 2

sensors = { near = { kind = 'neighbours', on = 'head' } }
--                                        ^ error: robot_model: field 'sensors.near.on' can't be used for neighbours: that sensor is always on the hull

sensors = { near = { kind = 'range', radius = 1 } }
--                                   ^ error: robot_model: unknown field 'sensors.near.radius': expected kind, at, yaw, on, range, minimum, cone, rays, noise, table, response, nothing, min_value, max_value, port

--- The message names a sensor that the robot needs and does not have.
return robot_model { mass = 1, sensors = { eye = { kind = 'range' } },
drive = { radius = 0.02, track = 0.1, needs = { 'eyes' } } }
--                                    ^ error: robot_model: field 'drive.needs' expected sensors, but there is no sensor 'eyes' (did you mean 'eye'?)

--- The message names a start button that the robot does not have.
sensors = { go = { kind = 'button' }, eye = { kind = 'range' } },
hardware = { driver = 'x', start = 'gu' }
--                         ^ error: robot_model: field 'hardware.start' expected a button, but there is no button 'gu' (did you mean 'go'?)

sensors = { eye = { kind = 'range' } }, hardware = { driver = 'x', start = 'eye' }
--                                                                 ^ error: robot_model: field 'hardware.start' expected a button, but there is no button 'eye'

--- The message names what is wrong with a driver that is a script, and with its devices.
hardware = { start = 'go' }  -- error at column 1: robot_model: field 'hardware.driver': expected either 'driver', a driver of nezumi, or 'script', a behaviour that drives the robot

hardware = { driver = 'x', devices = { line = serial { path = '/dev/ttyACM0' } } }
--                         ^ error: robot_model: field 'hardware.devices': 'devices' and 'device_model' can be used only with 'script'

hardware = { script = 'robot_controller', devices = { line = serial { boud = 9600 } } }
--                                                    ^ error: robot_model: unknown field 'hardware.devices.line.boud' (did you mean 'baud'?)

hardware = { script = 'robot_controller', devices = { line = serial { baud = 1 } } }
--                                                    ^ error: robot_model: parameter 'baud' (integer): 1 is below its minimum 50

hardware = { script = 'robot_controller', devices = { hat = i2c { safe = false } } }
--                                                    ^ error: robot_model: device 'hat': address: expected the device's address on the bus, such as 0x40

hardware = { script = 'robot_controller', devices = { hat = i2c { address = 0x40, registers = { 0, 2 }, lengths = { 1 } } } }
--                                                    ^ error: robot_model: device 'hat': lengths: expected the number of bytes of each of the 2 registers, got 1 numbers

hardware = { script = 'robot_controller', devices = { hat = i2c { address = 0x78 } } }
--                                                    ^ error: robot_model: parameter 'address' (integer): 120 is above its maximum 119

hardware = { script = 'robot_controller', devices = { pins = gpio { outputs = { 5, 6 }, safe = '5=0' } } }
--                                                    ^ error: robot_model: device 'pins': safe: output 6 has no level: add 6=0 or 6=1

hardware = { script = 'robot_controller', devices = { pins = gpio { inputs = { 5 }, pull = 'high', safe = false } } }
--                                                    ^ error: robot_model: parameter 'pull' (string): "high" is not one of its choices "none", "up", "down"

--- The message about a value of the wrong type names its field of the robot.
return robot_model { mass = 0, body = { size = { 1, 1, 1 } }, drive = { radius = 1, track = 1 } }
--                   ^ error: robot_model: field 'mass' expected a positive number, got 0

return robot_model { mass = 1, body = { size = { 1, 1 } }, drive = { radius = 1, track = 1 } }
--                                      ^ error: robot_model: field 'body.size' expected 3 numbers { x, y, z }, got 2

return robot_model { mass = 1, body = { shape = 'cyl', size = { 1, 1, 1 } }, drive = { radius = 1, track = 1 } }
--                                      ^ error: robot_model: field 'body.shape' expected one of box, cylinder, got 'cyl'

return robot_model { mass = 1, body = { shape = 'cylinder', size = { 1, 2, 1 } }, drive = { radius = 1, track = 1 } }
--                                                          ^ error: robot_model: field 'body.size' expected { diameter, diameter, height } of a cylinder

return robot_model { mass = 1, body = 'box', drive = { radius = 1, track = 1 } }
--                             ^ error: robot_model: field 'body' expected a table, got string

sensors = { a = { kind = 'rnage' } }
--                ^ error: robot_model: field 'sensors.a.kind' expected one of range, button, touch, gyro, color, reflect, ambient, scan, imu, neighbours, got 'rnage' (did you mean 'range'?)

sensors = { a = 5 }
--          ^ error: robot_model: field 'sensors.a' expected a table, got number

sensors = { a = { kind = 'range', noise = -1 } }
--                                ^ error: robot_model: field 'sensors.a.noise' expected a number from 0 on, got -1

sensors = { a = { kind = 'range', minimum = 0.7 } }
--                                ^ error: robot_model: field 'sensors.a.minimum' expected less than the range of 0.6 m, got 0.7

sensors = { ['a b'] = { kind = 'range' } }
--           ^ error: robot_model: sensors: 'a b' is not a valid name: expected letters, digits and _

sensors = { velocity = { kind = 'range' } }
--          ^ error: robot_model: a sensor can't have the name 'velocity': it is reserved for a measurement of the wheels

actuators = { a = { kind = 'servo', minimum = 1, maximum = 0 } }
--                                  ^ error: robot_model: field 'actuators.a.minimum': 1 is above maximum 0

sensors = { a = { kind = 'range', on = 'neck' } }, actuators = { neckk = { kind = 'servo' } }
--                                ^ error: robot_model: field 'sensors.a.on' expected a servo, but there is no servo 'neck' (did you mean 'neckk'?)

--- A port of a robot must not have the name of a member of every component or robot.
ports = { truth = { type = 'TimedPose2D', from = 'odometry' } }
--        ^ error: robot_model: port 'truth': the name is already used: robot.truth is a member of every component

ports = { collided = { type = 'TimedPose2D', from = 'odometry' } }
--        ^ error: robot_model: port 'collided': the name is already used: robot.collided is a member of every component

ports = { status = { type = 'TimedPose2D', from = 'odometry' } }
--        ^ error: robot_model: port 'status': the name is already used: robot.status is a member of every component

ports = { config = { type = 'TimedPose2D', from = 'odometry' } }
--        ^ error: robot_model: port 'config': the name is already used: robot.config is a member of every component

--- The message about a missing field of a robot says what is expected.
return robot_model {}  -- error: robot_model: field 'mass' is missing: expected a positive number in kg: of the whole robot

return robot_model { mass = 1 }
-- error: robot_model: field 'drive' is missing: expected { radius =, left_radius =, right_radius =, track =, pulses_per_turn =, skid =, coasts_until_commanded =, limits =, hardware_limits =, needs =, port = }: wheels, skids and limits

return robot_model { mass = 1, body = { size = { 1, 1, 1 } }, drive = { radius = 1 } }
--                                                            ^ error: robot_model: field 'drive.track' is missing: expected a positive number in m: between the wheels

sensors = { a = {} }
--          ^ error: robot_model: field 'sensors.a.kind' is missing: expected one of range, button, touch, gyro, color, reflect, ambient, scan, imu, neighbours: what it measures

ports = { a = { to = 'drive' } }
--        ^ error: robot_model: field 'ports.a.type' is missing: expected a string: a message type

--- A port carries values of existing sensors that fit its type.
sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedShortSeq', from = { 'front', 'bck' } } }
--        ^ error: robot_model: port 'p': there is no sensor 'bck' (did you mean 'back'?)

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedShortSek', from = 'front' } }
--        ^ error: robot_model: port 'p': unknown type 'TimedShortSek' (did you mean 'TimedShortSeq'?); `nezumi types` lists them all

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedShort', from = { 'front', 'back' } } }
--        ^ error: robot_model: port 'p': a TimedShort carries the value of one sensor, not of 2

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedVelocity2D', from = 'front' } }
--        ^ error: robot_model: port 'p': a TimedVelocity2D can't carry sensors' values

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedPose2D', from = 'velocity' } }
--        ^ error: robot_model: port 'p': 'velocity' is a TimedVelocity2D, not a TimedPose2D

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedShort', to = 'lamps' } }
--        ^ error: robot_model: port 'p': 'lamps' takes a TimedBooleanSeq, not a TimedShort

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedBooleanSeq', to = 'lamp' } }
--        ^ error: robot_model: port 'p': there is no actuator 'lamp' (did you mean 'lamps'?)

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedShortSeq' } }
--        ^ error: robot_model: port 'p': expected either 'from' (the source of an out-port) or 'to' (the target of an in-port)

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedShortSeq', from = 'front', to = 'lamps' } }
--        ^ error: robot_model: port 'p': expected either 'from' (the source of an out-port) or 'to' (the target of an in-port)

sensors = { front = { kind = 'range' }, back = { kind = 'range' } }, actuators = { lamps = { kind = 'leds' } },
ports = { p = { type = 'TimedShortSeq', from = {} } }
--                                      ^ error: robot_model: field 'ports.p.from' expected a name or a list of names, got another table

ports = { a = { type = 'TimedVelocity2D', to = 'drive' }, b = { type = 'TimedVelocity2D', to = 'drive' } }
-- error at column 1: robot_model: port 'b': a robot can have only one in-port for its drive

--- Limits of values that a sensor does not have are refused.
sensors = { a = { kind = 'range', nothing = 3 } }
--                                ^ error: robot_model: field 'sensors.a.nothing' can be used only for a sensor with a 'table' or a 'response'

--- A robot that is too light or too small for the physics is refused.
return robot_model { mass = 1e-9,
--                   ^ error: robot_model: field 'mass' expected at least 0.001 kg, got 1e-09
body = { size = { 1, 1, 1 } },
drive = { radius = 1, track = 1 } }

return robot_model { mass = 1,
body = { size = { 1, 1e-7, 1 } },
--       ^ error: robot_model: field 'body.size' expected lengths of at least 0.001 m
drive = { radius = 1, track = 1 } }

return robot_model { mass = 1,
body = { shape = 'cylinder', radius = 1e-7, height = 1 },
--                           ^ error: robot_model: field 'body.radius' expected at least 0.001 m, got 1e-07
drive = { radius = 1, track = 1 } }

return robot_model { mass = 1,
body = { size = { 1, 1, 1 } },
drive = { radius = 1e-7, track = 1 } }
--        ^ error: robot_model: field 'drive.radius' expected at least 0.001 m, got 1e-07

return robot_model { mass = 1,
body = { size = { 1, 1, 1 } },
drive = { radius = 1, track = 1e-7 } }
--                    ^ error: robot_model: field 'drive.track' expected at least 0.001 m, got 1e-07

--- A body that is completely below the floor is refused.
return robot_model { mass = 1,
body = { size = { 0.1, 0.1, 0.1 }, at = { 0, 0, -1 } },
--                                 ^ error: robot_model: field 'body.at' puts the hull below the floor: its top is at -0.95 m
drive = { radius = 0.02, track = 0.1 } }

return robot_model { mass = 1,
body = { size = { 0.1, 0.1, 0.1 }, at = { 0, 0, 0 } },
drive = { radius = 0.02, track = 0.1 } }

--- The response of a sensor must be a function of the distance.
sensors = { a = { kind = 'range',
 response = 5 } }  -- error at column 2: robot_model: field 'sensors.a.response' expected a function of the distance, got number

sensors = { a = { kind = 'range',
 response = function(d, e) return 1 end } }
-- error at column 2: robot_model: field 'sensors.a.response': its parameter 'e' is never given: leave it out

sensors = { a = { kind = 'range',
 response = function() end } }
-- error at column 2: robot_model: field 'sensors.a.response': returned nil for a distance of 0 m, expected a number

sensors = { a = { kind = 'range',
 response = function(d) return 0 / 0 end } }
-- error at column 2: robot_model: field 'sensors.a.response': returned nan for a distance of 0 m, expected a number

sensors = { a = { kind = 'range',
 response = function(d) return math.huge end } }
-- error at column 2: robot_model: field 'sensors.a.response': returned only values that are not finite numbers

sensors = { a = { kind = 'range',
 response = function(d)
 return d.x  -- error: response(0): attempt to index a number value (local 'd')
 end } }

sensors = { a = { kind = 'range',
 response = function(d) return 1 end, table = 'ir_table.csv' } }
-- error at column 2: robot_model: field 'sensors.a.response' and 'table' exclude each other: give one of them

sensors = { a = { kind = 'range',
 response = function(d) while true do end end } }  -- error: response(0): ran for more than 2 s: is there an endless loop?

sensors = { a = { kind = 'range', table = 'no.csv' } }
--                                ^ error: robot_model: field 'sensors.a.table': there is no file 'no.csv'; looked for engine/robots/no.csv, engine/robots/no.csv, behaviors/no.csv

sensors = { a = { kind = 'range', table = { { 0.2, 1 }, { 0.1, 2 } } } }
--                                ^ error: robot_model: field 'sensors.a.table': distances must ascend: 0.1 m comes after 0.2 m

sensors = { a = { kind = 'range', table = { 1, 2 } } }
--                                ^ error: robot_model: field 'sensors.a.table' expected a file's name or points { distance, value }

sensors = { a = { kind = 'range', table = { { 0.1, 1 }, { 0.2, 2 } }, min_value = 3, max_value = 2 } }
--                                                                    ^ error: robot_model: field 'sensors.a.min_value': 3 is above max_value 2
