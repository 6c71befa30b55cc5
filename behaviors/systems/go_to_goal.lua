--- A mouse drives where it is told: `driver:go(0.5, 0.3, math.pi / 2)`.
robot    "mouse"  { model = "raspimouse" }
behavior "driver" { script = "go_to_goal" }

connect("mouse.current_pose_out", "driver.pose")
connect("driver.target", "mouse.target_velocity_in")
