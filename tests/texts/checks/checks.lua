-- Mistakes that `nezumi check` finds in files, without running them. All files of a case are in one project.

--- A calibration is checked.
-- file: behaviors/systems/mouse.calibration.lua
calibration { robot = 'mouse', model = 'raspimouse' }

-- file: behaviors/systems/a.calibration.lua
calibration { robot = 'mouse', modle = 'raspimouse' }
--                             ^ error: calibration: unknown field 'modle' (did you mean 'model'?)

-- file: behaviors/systems/b.calibration.lua
calibration { robot = 'a', model = 'b' }
calibration { robot = 'a', model = 'b' }  -- error: calibration: is called twice: a file can have only one

--- The driver of a robot file must exist.
-- file: behaviors/good.lua
return robot_model {
  base = 'raspimouse',
  hardware = {
    driver = 'raspimouse' },
}

-- file: behaviors/wrong.lua
return robot_model {
  base = 'raspimouse',
  hardware = {
    driver = 'raspimous' },
--  ^ error: robot_model: field 'hardware.driver' expected a driver, but there is no driver 'raspimous' (did you mean 'raspimouse'?)
}

-- file: behaviors/unknown.lua
return robot_model {
  base = 'raspimouse',
  hardware = {
    driver = 'hover' },
--  ^ error: robot_model: field 'hardware.driver' expected a driver, but there is no driver 'hover'; there are ev3, raspimouse
}

--- A camera with invalid parameters is refused.
-- file: behaviors/systems/good.lua
component 'eye' { type = 'Camera', config = { frame_rate = 100, k1 = -0.1 } }

-- file: behaviors/systems/fast.lua
component 'eye' { type = 'Camera', config = { frame_rate = 1000 } }
-- error: component 'eye': frame_rate 1000 Hz is above the tick's 100 Hz

-- file: behaviors/systems/bent.lua
component 'eye' { type = 'Camera', config = { k1 = -5 } }
-- error: component 'eye': a distortion of k1 = -5, k2 = 0, p1 = 0, p2 = 0, k3 = 0 folds the picture over: take smaller ones, or a smaller field of view

--- All mistakes of a behaviour are found, and its callbacks are not run.
-- file: behaviors/globals.lua
local target = output('out', 'TimedVelocity2D')
function on_execute()
  if config.x then taget:write {} end
--                 ^ error: unknown global 'taget' (did you mean 'target'?)
  count = 1
--^ error: unknown global 'count' (declare it first: local count)
end
function on_activate() end
--       ^ error: unknown callback 'on_activate' (did you mean 'on_activated'?)

-- file: behaviors/type.lua
local p = input('in', 'TimedShrot')
-- error: input 'in': unknown type 'TimedShrot' (did you mean 'TimedShort'?); `nezumi types` lists them all

-- file: behaviors/declarations.lua
local p = input('in', 'TimedShrot')
-- error: input 'in': unknown type 'TimedShrot' (did you mean 'TimedShort'?); `nezumi types` lists them all
local q = output('in', 'TimedShort', { saef = 1 })  -- error: output 'in': unknown option 'saef' (did you mean 'safe'?)
param('x', 3, { min = 4 })  -- error: parameter 'x' (integer): 3 is below its minimum 4, in its default
param('x', 1 / 0)  -- error: parameter 'x' (number): inf is not a finite number, in its default
command('go', 1)  -- error: command 'go': expected a function, got number
log.info(config.x)

-- file: behaviors/empty.lua
-- nothing  -- error: behaviors/empty.lua: the file declares nothing: no port, parameter, command, task or callback

-- file: behaviors/never_called.lua
function on_execute() error('never called') end

--- A mistake of a module is found in the module and through the behaviour that requires it.
-- file: behaviors/lib/steering.lua
local M = {}
function M.turn() return mth.pi end
--                       ^ error: unknown global 'mth' (did you mean 'math'?)
return M

-- file: behaviors/a.lua
local steering = require 'lib.steering'
function on_execute() end  -- error: behaviors/lib/steering.lua:2:26: unknown global 'mth' (did you mean 'math'?)

--- A system is checked with its ports, types, parameters and scripts.
-- file: behaviors/systems/a.lua
robot "mouse" { model = "raspimouse" }
behavior "c" { script = "robot_controller", config = { speed_y = 1 } }
--                                                     ^ error: c: config: unknown parameter 'speed_y' (did you mean 'speed_x'?)
behavior "d" { script = "broken" }
behavior "e" { script = "robot_controller" }
connect("mouse.ir_sensor_outt", "e.in")  -- error: mouse has no out-port 'ir_sensor_outt' (did you mean 'ir_sensor_out'?)
connect("mouse.ir_sensor_out", "e.out")
-- error: connect goes from an out-port to an in-port: mouse.ir_sensor_out (TimedShortSeq) is an out-port, e.out (TimedVelocity2D) is an out-port (did you mean 'e.in'?)
connect("e.out", "mouse.target_velocity_in")
connect("e.out", "d.in")
connect("mouse.ir_sensor_out", "mouse.target_velocity_in")  -- error: behaviors/broken.lua:1:23: unknown global 'oops'
-- error: types differ: mouse.ir_sensor_out is TimedShortSeq, mouse.target_velocity_in is TimedVelocity2D (did you mean 'mouse.current_velocity_out'?)

-- file: behaviors/broken.lua
function on_execute() oops() end
--                    ^ error: unknown global 'oops'

--- A mistake of a script is reported once, also if a system uses it twice.
-- file: behaviors/systems/s.lua
behavior 'a' { script = 'slip' }
behavior 'b' { script = 'slip' }
behavior 'c' { script = 'wrong' }
behavior 'd' { script = 'good' }
connect('d.ou', 'd.in')  -- error: behaviors/slip.lua:2:38: config: unknown parameter 'q'
-- error: behaviors/wrong.lua:1: output 'p': unknown type 'TimedLnog' (did you mean 'TimedLong'?); `nezumi types` lists them all
-- error: behaviors/wrong.lua:3: parameter 'x': unknown option 'mim' (did you mean 'min'?)
-- error: d has no out-port 'ou' (did you mean 'out'?)

-- file: behaviors/good.lua
output('out', 'TimedLong')

-- file: behaviors/slip.lua
local out = output('out', 'TimedLong')
local function never() return config.q end
--                                   ^ error: config: unknown parameter 'q'
function on_execute() out:write(1) end

-- file: behaviors/wrong.lua
local p = output('p', 'TimedLnog')
-- error: output 'p': unknown type 'TimedLnog' (did you mean 'TimedLong'?); `nezumi types` lists them all
param('x', 1, { mim = 0 })  -- error: parameter 'x': unknown option 'mim' (did you mean 'min'?)

--- The scripts of a system are checked with its parameter values.
-- file: good.lua
behavior 'b' { script = 'picky', config = { side = 'left' } }
behavior 'c' { script = 'picky', sets = { near = { side = 'left' } }, set = 'near' }

-- file: wrong.lua
behavior 'b' { script = 'picky', config = { side = 'right' } }  -- error: behaviors/picky.lua:2: say side

-- file: behaviors/picky.lua
param('side', 'left')
if config.side ~= 'left' then error('say side') end
function on_execute() end

--- The message about a global of another kind of file is the same as in a run.
-- file: behaviors/systems/s.lua
log.info('x')
-- error at column 1: unknown global 'log': it is for behaviours; in a system file write `behavior NAME { script = ... }`
rate(50)
seed(1)

-- file: behaviors/b.lua
local out = output('out', 'TimedLong')

-- file: behaviors/systems/t.lua
rate(50) require 'b'
-- error: behaviors/b.lua:1:13: unknown global 'output': it is for behaviours; in a system file write `behavior NAME { script = ... }`

--- The secret of a network must be a file.
-- file: systems/missing.lua
rate(100)
network { name = 'pi', secret = 'nofile' }
-- error: network: the secret 'nofile' does not exist: `nezumi network secret FILE` makes one, to be copied to each host
connect('a.b', 'c.d')  -- error: 'a.b': there is no component 'a'

--- Overlapping robots and unknown models of a system are found.
-- file: behaviors/systems/overlap.lua
robot 'a' { model = 'raspimouse' }
robot 'b' { model = 'raspimouse' }  -- error: robot 'b' at x = 0, y = 0 overlaps robot 'a': move one of them

-- file: behaviors/systems/model.lua
robot 'a' { model = 'raspimose' }
--          ^ error: robot 'a': there is no robot model 'raspimose' (did you mean 'raspimouse'?); looked for behaviors/systems/raspimose.lua, behaviors/raspimose.lua, engine/robots/raspimose.lua, behaviors/raspimose.lua

--- Robot files, modules of systems and scenarios are checked.
-- file: behaviors/r.lua
return robot_model { mass = 1, drive = { radius = 0.02 } }
--                             ^ error: robot_model: field 'drive.track' is missing: expected a positive number in m: between the wheels

-- file: behaviors/lib/m.lua
return function() robot('m', {}); conect('a.b', 'c.d') end
--                                ^ error: unknown global 'conect' (did you mean 'connect'?)

-- file: tests/a_test.lua
scenaro('x', function(s) end)  -- error at column 1: unknown global 'scenaro' (did you mean 'scenario'?)

-- file: tests/b_test.lua
scenario('x', function(s) error('never run') end)

-- file: tests/c_test.lua
scenario('x', { timout = 3 }, function(s) end)
--              ^ error: scenario 'x': unknown option 'timout' (did you mean 'timeout'?)

--- A wrong field of a library is found in every kind of file.
-- file: tests/a_test.lua
scenario('x', function(s) s:run(math.flor(1.5)) end)
--                                   ^ error: unknown field 'math.flor' (did you mean 'math.floor'?)

-- file: behaviors/lib/m.lua
return { f = function(x) return math.flor(x) end }
--                                   ^ error: unknown field 'math.flor' (did you mean 'math.floor'?)

-- file: behaviors/systems/s.lua
rate(math.flor(50.5))
--        ^ error: unknown field 'math.flor' (did you mean 'math.floor'?)

-- file: behaviors/r.lua
return robot_model { mass = math.flor(1) }
--                               ^ error: unknown field 'math.flor' (did you mean 'math.floor'?)

--- Ports that are connected to RTCs are checked without the RTCs.
-- file: systems/s.lua
robot 'mouse' { model = 'raspimouse' }
rtm { export = 'mouse', rename = { ['mouse.pose_updat'] = 'pose_update_in' } }
-- error: rtm: field 'rename': there is no exported port 'mouse.pose_updat' (did you mean 'mouse.pose_update'?)
connect('rtm:Out0.out', 'mouse.current_pose_out')  -- error: connect: mouse.current_pose_out is an out-port: connect goes from an out-port to an in-port
connect('rtm:Out0.out', 'mouse.target_velocity_inn')
-- error: connect: mouse has no port 'target_velocity_inn' (did you mean 'target_velocity_in'?)
connect('rtm:Out0.out', 'mouse.target_velocity_in')
