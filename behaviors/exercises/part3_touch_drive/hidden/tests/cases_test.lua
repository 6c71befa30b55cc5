scenario("all cases, at any speed", { sweep = { speed = { 0.05, 0.2 } } }, function(s, p)
  s:behavior("driver", { script = "driver", config = { speed = p.speed } })
  local function touch(right, left)
    s:inject("driver.touch", { right, left })
    s:run(0.02)
    return s.driver.target_velocity.value.vx
  end
  s:near(touch(true, false), p.speed, 1e-9, "right")
  s:near(touch(false, true), -p.speed, 1e-9, "left")
  s:near(touch(false, false), 0, 1e-9, "none")
  s:near(touch(true, true), p.speed, 1e-9, "both: the right one wins")
end)
