calibration {
  robot = "mouse",
  model = "raspimouse",
  serial = "10000000abcdef01",
  odometry = { track = 0.0957, left_radius = 0.0242, right_radius = 0.0238 },
  sensors = { right_front = { table = { { 0.02, 795 }, { 0.05, 300 }, { 0.3, 12 } } } },
}
