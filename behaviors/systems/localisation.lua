--- A mouse drives in a circle among markers and finds out where it is. It believes that it was set down elsewhere.
local boards, places = {}, {}
for i = 0, 7 do
  local angle = i * math.pi / 4
  local x, y = 0.9 * math.cos(angle), 0.9 * math.sin(angle)
  boards[#boards + 1] = marker { id = i, size = 0.1, at = { x, y, 0.07 }, facing = angle + math.pi }
  boards[#boards + 1] = box { at = { 1.012 * x, 1.012 * y, 0.07 }, size = { 0.02, 0.14, 0.14 }, yaw = angle }
  for _, value in ipairs { i, x, y } do places[#places + 1] = value + 0.0 end
end
arena { size = { 2.0, 2.0 }, boards }

robot     "mouse"    { model = "raspimouse", pose = { x = 0.38, y = -0.1, heading = 1.8 } }
component "eye"      { type = "Camera", on = "mouse", at = { 0.05, 0.0, 0.06 },
                       config = { width = 320, height = 240, frame_rate = 10.0, noise = 12.0 } }
component "detector" { type = "MarkerDetector", config = { tag_size = 0.1 } }
behavior  "place"    { script = "localisation", config = { markers = places, initial = { 0.3, 0.0, math.pi / 2 } } }
behavior  "driver"   { script = "robot_controller", config = { speed_x = 0.15, speed_r = 0.5 } }

connect("eye.out", "detector.image")
connect("detector.pos", "place.marker")
connect("detector.id", "place.id")
connect("mouse.current_pose_out", "place.odometry")
connect("mouse.ir_sensor_out", "driver.in")
connect("driver.out", "mouse.target_velocity_in")
