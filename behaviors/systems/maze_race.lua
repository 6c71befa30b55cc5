--- A mouse in a contest's maze. The maze and the behaviour are arguments, as in `--set solver=diagonal`.
local file   = argument("maze", "mazes/first.txt", { doc = "the contest's file" })
local solver = argument("solver", "flood_fill", { doc = "the behaviour: flood_fill, diagonal, left_hand" })

local contest = maze(file)

arena { contest }
robot    "mouse"  { model = "raspimouse", pose = contest.pose }
behavior "solver" {
  script = solver,
  config = { home = contest.start, direction = contest.direction, goal = contest.goal, size = { contest.columns, contest.rows } },
}

connect("mouse.current_pose_out", "solver.pose")
connect("mouse.ir_sensor_metre_out", "solver.ranges")
connect("solver.target", "mouse.target_velocity_in")
