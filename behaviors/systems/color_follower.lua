--- A mouse follows another one by the red box that it carries.
arena { box { at = { 0.4, 0.0, 0.105 }, size = { 0.06, 0.06, 0.06 }, mass = 0.03, color = "red" } }

robot    "leader" { model = "raspimouse", pose = { x = 0.4, y = 0, heading = 0 } }
behavior "driver" { script = "robot_controller", config = { speed_x = 0.12, speed_r = 0.2 } }

robot     "mouse"    { model = "raspimouse", pose = { x = 0, y = 0, heading = 0 } }
component "eye"      { type = "Camera", on = "mouse", at = { 0.05, 0.0, 0.08 }, config = { width = 320, height = 240 } }
component "detector" { type = "ColorDetector", config = { hue_from = 340.0, hue_to = 20.0 } }
behavior  "follower" { script = "color_follower" }

connect("leader.ir_sensor_out", "driver.in")
connect("driver.out", "leader.target_velocity_in")
connect("eye.out", "detector.image")
connect("detector.centre", "follower.centre")
connect("detector.area", "follower.area")
connect("follower.target", "mouse.target_velocity_in")
