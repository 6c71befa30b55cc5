-- The objects of a running system in Lua: what they show, accept and refuse.

--- The result of a command belongs to the caller.
local _, list = controller:add(1, { 1, { 2 } }) list[1] = 5 list[2][1] = 6 return list[1]  -- returns: 5

--- The message about an unknown field of a message or of the truth gives the nearest field.
return mouse.truth.pose.positon.x  -- error: 'mouse.truth.pose' has no field 'positon' (did you mean 'position'?)

return mouse.truth.pose.x  -- error: 'mouse.truth.pose' has no field 'x' (its fields are heading, position)

return mouse.truth.pose.position.z  -- error: 'mouse.truth.pose.position' has no field 'z' (its fields are x, y)

return controller.out.value.vz  -- error: 'controller.out.value' has no field 'vz' (did you mean 'va'?)

return mouse.ir_sensor_out.value[9], mouse.ir_sensor_out.value.vx, controller.state.nothing, rawget(mouse.truth.pose, 'x')
-- returns: nil nil nil nil

--- A component shows its name, type, status and version.
return controller.name, controller.type, controller.status, controller.version  -- returns: controller Counter ACTIVE 1

return mouse.status, mouse.version, mouse.name  -- returns: ACTIVE 1 mouse

return controller.rate, controller.set, controller.error  -- returns: 100.0 nil nil

return table.concat(controller.commands, ' '), table.concat(controller.sets, ' ')  -- returns: add fail both fast slow

--- The message about an unknown name gives the nearest name.
return controller.statsu  -- error: controller has no 'statsu' (did you mean 'status'?)

return controller.ports.ot  -- error: controller has no port 'ot' (did you mean 'out'?)

return world.contoller  -- error: there is no component 'contoller' (did you mean 'controller'?)

return controller.config.sped_x  -- error: controller: unknown parameter 'sped_x' (did you mean 'speed_x'?)

return controller.speed_x  -- error: controller has no 'speed_x': its parameter is controller.config.speed_x

return controller.out.valu  -- error: controller.out has no 'valu' (did you mean 'value'?)

return controller.out[1]  -- error: controller.out is the port, not its value: its value is controller.out.value

return mouse.truth.position  -- error: mouse.truth has no 'position'

return controller.collided  -- error: controller has no 'collided'

return controller[1]  -- error: controller is a component: expected the name of a member

--- State is a copy that can't be changed.
return controller.state.count, controller.state.list[2].deep  -- returns: 0 true

controller.state.count = 3
-- error: can't set 'controller.state.count': 'controller.state' is a copy: a command of its script can change it

controller.state.list[2].deep = false
-- error: can't set 'controller.state.list[2].deep': 'controller.state.list[2]' is a copy: a command of its script can change it

return mouse.state.any  -- returns: nil

--- A component is activated, deactivated and reset, and its parameter set is selected.
return controller:deactivate(), controller.status  -- returns: INACTIVE INACTIVE

return controller:activate(), controller.status  -- returns: ACTIVE ACTIVE

controller:reset()  -- error: controller is ACTIVE: only a component in ERROR can be reset

controller:use 'fast' return controller.config.speed_x, controller.set  -- returns: 0.5 fast

controller:use 'fsat'  -- error: controller has no parameter set 'fsat' (did you mean 'fast'?)

controller.activate()  -- error: activate: write `X:activate(...)` with a colon, not `X.activate(...)`

--- Commands run in the Lua state of their component, between ticks.
return controller:add(2, 'b')  -- returns: 2 b

return controller:add(3), controller.state.count  -- returns: 5 5

controller:fail()  -- error: ...behaviors/counter.lua:10: no luck

controller:both()
-- error: ...behaviors/counter.lua:11: output 'out' (TimedVelocity2D): field 'va' expected a number, got string

return controller.status  -- returns: ACTIVE

controller:add(print)  -- error: command 'add': argument 1 is a function, and only plain data can be given

local t = {} for i = 1, 9999 do t[i] = i end controller:add(t)
-- error: ...behaviors/counter.lua:9: attempt to perform arithmetic on a table value (local 'a')

local t = {} for i = 1, 10000 do t[i] = i end controller:add(t)
-- error: command 'add' got 10001 values: at most 10000 are allowed, so that no tick is late

controller:add(('x'):rep(1048577))
-- error: command 'add' got 1048577 bytes of text: at most 1048576 are allowed, so that no tick is late

controller.add(1)  -- error: add: write `X:add(...)` with a colon, not `X.add(...)`

--- A wrong value gives the same message as in a behaviour.
controller.out:write { vx = 'x' }  -- error: output 'out' (TimedVelocity2D): field 'vx' expected a number, got string

inject(controller['in'], { 1, 40000 })
-- error: input 'in' (TimedShortSeq): element 2 expected an integer from -32768 to 32767, got 40000

inject('controller.inn', {})  -- error: controller has no port 'inn' (did you mean 'in'?)

inject(controller, {})  -- error: expected a port, got the component controller: write controller.PORT

inject()  -- error: expected a port or "name.port", got nothing

hold('controller.in')  -- error: expected a value for controller.in

inject('controller', {})  -- error: 'controller' is not a port: expected "name.port"

--- The truth can't be set, and the message says what to use.
mouse.truth.pose.position.x = 3
-- error: can't set 'mouse.truth.pose.position.x': 'mouse.truth.pose.position' is a copy: write mouse:teleport { x =, y =, heading = }

mouse.truth.pose.heading = 1
-- error: can't set 'mouse.truth.pose.heading': 'mouse.truth.pose' is a copy: write mouse:teleport { x =, y =, heading = }

mouse.truth.velocity.vx = 1
-- error: can't set 'mouse.truth.velocity.vx': 'mouse.truth.velocity' is a copy: write mouse:disturb { vx =, vy =, va = }

mouse.truth.pose = { x = 1 }  -- error: the truth can't be set: use teleport for the pose, disturb for the velocity

mouse:teleport(mouse.truth.pose) return mouse.truth.pose.position.x  -- returns: 0.0

--- A port can't be assigned, and the message names it.
controller.ports.zzz = 3  -- error: zzz can't be set

controller.ports[1] = 'zzz'  -- error: this member can't be set

controller.ports.out.zzz = 3  -- error: controller.out: its members can't be set; write a value with :write(value)

--- Every documented member of a port has its documented type.
hold('controller.out', { vx = 0.1 })

return type(controller.out.age)  -- returns: number

return type(controller.out.connected)  -- returns: boolean

return type(controller.out.count)  -- returns: number

return type(controller.out.direction)  -- returns: string

return type(controller.out.doc)  -- returns: string

return type(controller.out.drop)  -- returns: function

return controller.out.fields[1]  -- returns: vx: number [m/s]

return controller.ports["in"].fields[1]  -- returns: []: integer

return type(controller.out.freeze)  -- returns: function

return type(controller.out.hold)  -- returns: function

return type(controller.out.holder)  -- returns: string

return type(controller.out.inject)  -- returns: function

return type(controller.out.name)  -- returns: string

return type(controller.out.note)  -- returns: string

return type(controller.out.override)  -- returns: string

return type(controller.out.path)  -- returns: string

return type(controller.out.peers)  -- returns: table

return type(controller.out.release)  -- returns: function

return type(controller.out.stale)  -- returns: boolean

return type(controller.out.tm)  -- returns: number

return type(controller.out.type)  -- returns: string

return type(controller.out.unread)  -- returns: boolean

return type(controller.out.write)  -- returns: function

--- Rounding errors near zero are shown as zero.
mouse:teleport { x = 1e-8, y = -1e-10, heading = 1e-12 } local pose = mouse.truth.pose return pose.position.x > 0, pose.position.y, pose.heading
-- returns: true 0.0 0.0

return tostring(mouse.truth)
-- returns: pose = { position = { x = 1e-08, y = 0 }, heading = 0 }\nvelocity = { vx = 0, vy = 0, va = 0 }\nheight = 0\ntilt = 0

--- Methods and functions refuse too many arguments.
return select(2, pcall(function() controller:activate(1) end))
-- returns: box.lua:1: controller:activate: expected no arguments, got 1: controller:activate()

return select(2, pcall(function() controller:reset(nil) end))
-- returns: box.lua:1: controller:reset: expected no arguments, got 1: controller:reset()

return select(2, pcall(function() controller:use('fast', 2) end))
-- returns: box.lua:1: controller:use: expected at most 1 argument, got 2: controller:use "SET"

return select(2, pcall(function() mouse:teleport({ x = 1 }, 2) end))
-- returns: box.lua:1: mouse:teleport: expected at most 1 argument, got 2: mouse:teleport(pose)

return select(2, pcall(function() mouse:disturb({}, 2) end))
-- returns: box.lua:1: mouse:disturb: expected at most 1 argument, got 2: mouse:disturb { vx =, vy =, va = }

return select(2, pcall(function() mouse:press('a', true, 3) end))
-- returns: box.lua:1: mouse:press: expected at most 2 arguments, got 3: mouse:press(sensor, pressed)

return select(2, pcall(function() controller.out:write({}, 2) end))
-- returns: box.lua:1: controller.out:write: expected at most 1 argument, got 2: controller.out:write(value)

return select(2, pcall(function() controller.out:hold({}, { take = true }, 3) end))
-- returns: box.lua:1: controller.out:hold: expected at most 2 arguments, got 3: controller.out:hold(value, { take = true })

return select(2, pcall(function() controller.out:release(1) end))
-- returns: box.lua:1: controller.out:release: expected no arguments, got 1: controller.out:release()

return select(2, pcall(function() mouse.teleport(controller, {}) end))
-- returns: box.lua:1: controller is not a robot: it has no 'teleport'
