--- A mouse in a maze, its left hand on the wall. Between any two cells of this one there is exactly one way.
arena { maze { generate = { columns = 8, rows = 8, seed = 4 } } }

robot    "mouse"  { model = "raspimouse", pose = { x = 0, y = 0, heading = math.pi / 2 } }
behavior "solver" { script = "left_hand" }

connect("mouse.current_pose_out", "solver.pose")
connect("mouse.ir_sensor_metre_out", "solver.ranges")
connect("solver.target", "mouse.target_velocity_in")
