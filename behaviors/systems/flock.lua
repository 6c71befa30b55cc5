--- Seven mice that look in all directions become a flock.
local COUNT = 7
for i = 1, COUNT do
  local angle = 2 * math.pi * i / COUNT
  local pose = { x = 0.4 * math.cos(angle), y = 0.4 * math.sin(angle), heading = 1.0 * i * i }
  robot("mouse_" .. i, { model = "raspimouse", pose = pose })
  behavior("flock_" .. i, { script = "flock", config = { initial = { pose.x, pose.y, pose.heading } } })
end
for i = 1, COUNT do
  for j = 1, COUNT do
    if i ~= j then connect("flock_" .. j .. ".place", "flock_" .. i .. ".others") end
  end
  connect("mouse_" .. i .. ".current_pose_out", "flock_" .. i .. ".pose")
  connect("mouse_" .. i .. ".ir_sensor_metre_out", "flock_" .. i .. ".ranges")
  connect("flock_" .. i .. ".target", "mouse_" .. i .. ".target_velocity_in")
end
