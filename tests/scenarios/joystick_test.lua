--- FloatSeqToVelocity by itself, every branch; the joystick; then the system in which it drives both robots at once.

local function converter_alone(s, config)
  s:behavior("converter", { script = "float_seq_to_velocity", config = config })
  local converter = s.converter
  local function push(...)
    s:inject("converter.in", { ... })
    s:run(0.02)
    return converter.out.value
  end
  return converter, push
end

scenario("up and down drive, left and right turn", function(s)
  local _, push = converter_alone(s)
  local function expect(x, y, vx, va)
    local v = push(x, y)
    s:near(v.vx, vx, 1e-9)
    s:near(v.va, va, 1e-9)
    s:near(v.vy, 0, 0)
  end
  expect(0, 150, 0.3, 0)
  expect(0, -150, -0.3, 0)
  expect(150, 0, 0, -3)
  expect(-150, 0, 0, 3)
  expect(50, 100, 0.2, -1)
  expect(0, 0, 0, 0)
end)

scenario("its factors are the configured ones", function(s)
  local _, push = converter_alone(s, { rotation_by_position = 0.01, velocity_by_position = -0.001 })
  local v = push(100, 50)
  s:near(v.vx, -0.05, 1e-9)
  s:near(v.va, 1, 1e-9)
end)

scenario("a joystick's sequence of length 0 or 1 is passed over, a longer one is not", function(s)
  local converter, push = converter_alone(s)
  push(0, 100)
  for _, short in ipairs { {}, { 150 } } do
    push(table.unpack(short))
    s:near(converter.out.value.vx, 0.2, 1e-9)
    s:check(converter.out.age > 0.015, "nothing was written")
  end
  s:check(converter.status == "ACTIVE")
  s:near(push(0, 50, 99, 98).vx, 0.1, 1e-9, "what follows the second number does not matter")
end)

scenario("acts only on new data", function(s)
  local converter, push = converter_alone(s)
  s:run(0.5)
  s:check(converter.out.age == math.huge, "silent before the first message")
  push(0, 100)
  s:run(0.5)
  s:check(converter.out.age > 0.45, "one message, one command")
end)

scenario("the joystick sends at its rate, whether or not it moved", { sweep = { rate = { 10, 20, 100 } } }, function(s, p)
  local stick = s:component("stick", { type = "Joystick", rate = p.rate })
  s:check(stick == s.stick and stick.type == "Joystick")
  s:run(0.05)
  s:always("is never older than a period", function() return s.stick.pos.age <= 1 / p.rate + 1e-9 end)
  s:run(1)
  s:near(#s.stick.pos.value, 2, 0)
  s:near(s.stick.pos.value[2], 0, 0)
  s:hold("stick.stick", { 60, 80 })
  s:run(0.2)
  s:near(s.stick.pos.value[1], 60, 0)
  s:near(s.stick.vel.value[1], 140 / math.sqrt(2), 1e-4, "left wheel")
  s:near(s.stick.vel.value[2], 20 / math.sqrt(2), 1e-4, "right wheel")
  s:release("stick.stick")
  s:run(0.2)
  s:near(s.stick.pos.value[2], 0, 0, "springs back")
  s:near(s.stick.vel.value[1], 0, 0)
end)

scenario("one joystick drives both robots at once", { timeout = 30 }, function(s)
  local world = s:load "systems/joystick.lua"
  local mouse, ev3 = world.mouse, world.ev3
  s:hold("stick.stick", { 0, 100 })
  s:run(1)
  s:near(mouse.truth.velocity.vx, 0.2, 0.005)
  s:near(ev3.truth.velocity.vx, 0.2, 0.005)
  s:hold("stick.stick", { -100, 0 })
  s:run(1)
  s:near(mouse.truth.velocity.va, 2, 0.05)
  s:near(ev3.truth.velocity.va, 2, 0.05)
  s:release("stick.stick")
  s:eventually("both stop", { within = 1 }, function()
    return math.abs(mouse.truth.velocity.va) < 0.001 and math.abs(ev3.truth.velocity.va) < 0.001
  end)
end)

scenario("a joystick that falls silent stops both robots", { timeout = 30 }, function(s)
  local world = s:load "systems/joystick.lua"
  s:hold("stick.stick", { 0, 100 })
  s:run(1)
  s:release "stick.pos"
  s:drop "stick.pos"
  s:eventually("both stop", { within = 1 }, function()
    return math.abs(world.mouse.truth.velocity.vx) < 0.001 and math.abs(world.ev3.truth.velocity.vx) < 0.001
  end)
end)
