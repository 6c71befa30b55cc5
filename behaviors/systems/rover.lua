--- A rover of one's own drives where it is told: `pilot:go(0.5, 0.3, math.pi / 2)`. Its driver is a behaviour.
robot    "rover" { model = "rover" }
behavior "pilot" { script = "go_to_goal" }

connect("rover.current_pose_out", "pilot.pose")
connect("pilot.target", "rover.target_velocity_in")
