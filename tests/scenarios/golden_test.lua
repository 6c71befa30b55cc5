--- The tutorial's drive to the wall, tick by tick, as it has been since it was committed.

scenario("the drive to the wall is the one that was recorded", function(s)
  local world = s:load "systems/stop_at_wall.lua"
  world.controller.config.speed_x = 0.5
  s:golden("../golden/stop_at_wall.csv", { tolerance = 1e-9 }, world.mouse.current_pose_out, world.mouse.ir_sensor_out,
    "controller.out")
  s:run(2)
end)
