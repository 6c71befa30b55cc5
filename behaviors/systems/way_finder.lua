--- A mouse looks for its way round a wall that it has not seen.
arena {
  size = { 3.2, 2.0 },
  wall { from = { 0.8, -0.5 }, to = { 0.8, 0.35 }, height = 0.1, thickness = 0.05 },
  wall { from = { 0.3, 0.35 }, to = { 0.8, 0.35 }, height = 0.1, thickness = 0.05 },
}

robot    "mouse"  { model = "raspimouse" }
behavior "finder" { script = "way_finder", config = { goal = { 1.2, 0.0 } } }

connect("mouse.current_pose_out", "finder.pose")
connect("mouse.ir_sensor_metre_out", "finder.ranges")
connect("finder.target", "mouse.target_velocity_in")
