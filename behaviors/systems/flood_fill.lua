--- A mouse learns a maze with several ways to the middle, and takes the shortest. The walls of the goal stand alone: the
--- left hand would never come there.
arena {
  maze { rows = {
    "+--+--+--+--+--+--+--+--+",
    "|           |           |",
    "+  +--+--+  +  +--+--+  +",
    "|  |     |     |        |",
    "+  +  +  +--+--+  +--+  +",
    "|     |           |     |",
    "+--+  +  +--+--+  +  +--+",
    "|     |  |     |  |     |",
    "+  +--+  +  +  +  +--+  +",
    "|  |     |     |     |  |",
    "+  +  +  +--+  +  +  +  +",
    "|     |           |     |",
    "+  +--+--+--+--+--+--+  +",
    "|  |              |     |",
    "+  +  +--+--+  +--+  +--+",
    "|  |        |           |",
    "+--+--+--+--+--+--+--+--+",
  } },
}

robot    "mouse"  { model = "raspimouse", pose = { x = 0, y = 0, heading = math.pi / 2 } }
behavior "solver" { script = "flood_fill", config = { goal = { 4, 4 } } }

connect("mouse.current_pose_out", "solver.pose")
connect("mouse.ir_sensor_metre_out", "solver.ranges")
connect("solver.target", "mouse.target_velocity_in")
