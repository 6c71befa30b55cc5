calibration { robot = "mouse", model = "raspimouse", odometry = { left = 1.01, right = 0.99, track = 1.0 } }
