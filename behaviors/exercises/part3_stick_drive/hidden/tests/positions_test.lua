scenario("a velocity for each position", function(s)
  s:behavior("converter", { script = "converter", config = { speed_by_y = 0.001, turn_by_x = 0.01 } })
  local function push(...)
    s:inject("converter.in", { ... })
    s:run(0.02)
    return s.converter.out.value
  end
  s:near(push(0, 100).vx, 0.1, 1e-6, "up")
  s:near(push(0, -100).vx, -0.1, 1e-6, "down")
  s:near(push(100, 0).va, -1, 1e-6, "right")
  s:near(push(-50, 0).va, 0.5, 1e-6, "left")
end)

scenario("a position that is too short is ignored", { sweep = { length = { 0, 1 } } }, function(s, p)
  s:behavior "converter" { script = "converter" }
  s:inject("converter.in", { 0, 100 })
  s:run(0.02)
  s:inject("converter.in", p.length == 1 and { 50 } or {})
  s:run(0.02)
  s:check(s.converter.status == "ACTIVE", "goes on")
  s:near(s.converter.out.value.vx, 0.2, 1e-6, "keeps the last velocity")
end)
