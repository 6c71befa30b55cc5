--- A rover whose driver is a behaviour drives to a place: `pilot:go(0.5, 0.3, math.pi / 2)`. Its motors are on I2C, and its
--- range finder is on GPIO.
arena { box { at = { 1.2, 0, 0.15 }, size = { 0.1, 1, 0.3 } } }

robot    "rover" { model = "hat_rover" }
behavior "pilot" { script = "go_to_goal" }

connect("rover.current_pose_out", "pilot.pose")
connect("pilot.target", "rover.target_velocity_in")
