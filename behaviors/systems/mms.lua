--- A mouse in a contest's maze, for solvers that were written for the simulator mms: `nezumi mms` runs it.
local file      = argument("maze", "mazes/first.txt", { doc = "the contest's file" })
local model     = argument("robot", "raspimouse", { doc = "the model; its ports are called as those of raspimouse" })
local thickness = argument("thickness", 0.012, { min = 0.001, max = 0.05, doc = "of the walls [m]" })

local contest = maze { file, thickness = thickness }

arena { contest }
robot    "mouse"  { model = model, pose = { x = 0, y = 0, heading = math.pi / 2 } }
behavior "driver" { script = "mms_mouse", config = { size = { contest.columns, contest.rows } } }

connect("mouse.current_pose_out", "driver.pose")
connect("mouse.ir_sensor_metre_out", "driver.ranges")
connect("driver.target", "mouse.target_velocity_in")
