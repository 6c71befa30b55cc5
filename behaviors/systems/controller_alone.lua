--- RobotController alone, no robot: a person is its sensors and looks at what it would tell the robot.
behavior "controller" { script = "robot_controller", config = { speed_x = 0.2 } }
