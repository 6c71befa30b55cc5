--- A mouse goes round a room with a box in it, its left side to the wall.
arena {
  size = { 1.6, 1.2 },
  box { at = { -0.7, 0.2, 0.05 }, size = { 0.2, 0.3, 0.1 } },
}

robot    "mouse"    { model = "raspimouse", pose = { x = 0, y = 0.45, heading = 0 } }
behavior "follower" { script = "wall_follower" }

connect("mouse.ir_sensor_metre_out", "follower.ranges")
connect("follower.target", "mouse.target_velocity_in")
