--- Fifty mice that look in all directions become a flock. Each sees only those near it, and hears what they say.
local count = argument("count", 50, { min = 2, max = 500, doc = "how many mice" })

local near = { kind = "neighbours", radius = 0.8, noise = 0.01, bearing_noise = 0.03, loss = 0.1 }
for i = 1, count do
  local distance, angle = 0.22 * math.sqrt(i), 2.4 * i -- like the seeds of a sunflower
  local pose = { x = distance * math.cos(angle), y = distance * math.sin(angle), heading = i * i % (2 * math.pi) }
  robot("mouse_" .. i, {
    model = "raspimouse",
    pose = pose,
    sensors = { near = near },
    ports = { near = { type = "NeighbourSeq", from = "near" }, say = { type = "TimedDoubleSeq", to = "say" } },
  })
  behavior("flock_" .. i, { script = "flock", config = { initial = { pose.x, pose.y, pose.heading } } })
  connect("mouse_" .. i .. ".near", "flock_" .. i .. ".others")
  connect("mouse_" .. i .. ".current_pose_out", "flock_" .. i .. ".pose")
  connect("mouse_" .. i .. ".ir_sensor_metre_out", "flock_" .. i .. ".ranges")
  connect("flock_" .. i .. ".say", "mouse_" .. i .. ".say")
  connect("flock_" .. i .. ".target", "mouse_" .. i .. ".target_velocity_in")
end
