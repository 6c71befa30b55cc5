--- The mice of the mazes: left_hand and flood_fill, set down a little beside and askew, with sensors that deviate by 5 %.

--- How far a mouse is from the middle of the lanes between the walls [m]. It touches one at 0.04 m.
local function off_lane(mouse)
  local at = mouse.truth.pose.position
  local x, y = (at.x + 0.09) % 0.18 - 0.09, (at.y + 0.09) % 0.18 - 0.09
  return math.min(math.abs(x), math.abs(y))
end

local function is_in(mouse, column, row)
  local at = mouse.truth.pose.position
  return math.abs(at.x - (column - 1) * 0.18) < 0.02 and math.abs(at.y - (row - 1) * 0.18) < 0.02
end

local badly_set_down = {
  timeout = 300,
  sweep = { x = range(-0.01, 0.01), y = range(-0.01, 0.01), askew = range(-0.1, 0.1) },
  samples = 2,
}

local function set_down(s, p, file)
  local world = s:load(file)
  s:teleport("mouse", { x = p.x, y = p.y, heading = math.pi / 2 + p.askew })
  s:always("keeps to its lane", function() return off_lane(world.mouse) < 0.03 end)
  s:never("touches anything", function() return world.mouse.collided end)
  return world
end

scenario("the left hand on the wall leads to the goal", badly_set_down, function(s, p)
  local world = set_down(s, p, "systems/left_hand.lua")
  s:eventually("is there", { within = 200 }, function() return world.solver.tasks.solve.status == "finished" end)
  s:check(is_in(world.mouse, 8, 8), "it is where it believes to be")
  s:check(world.solver.state.cells >= 14, "no way is shorter")
end)

scenario("flood fill learns the maze and takes the shortest way", badly_set_down, function(s, p)
  local world = set_down(s, p, "systems/flood_fill.lua")
  s:eventually("knows it", { within = 200 }, function() return world.solver.state.known end)
  s:check(world.solver.state.known == 10, "the shortest way through this maze has 10 cells")
  s:check(is_in(world.mouse, 1, 1), "it is at the start again")
  local begun = s:now()
  s:eventually("is there", { within = 30 }, function() return world.solver.tasks.solve.status == "finished" end)
  s:check(is_in(world.mouse, 4, 4), "it is where it believes to be")
  s:check(s:now() - begun < 15, "it drives no other way")
end)

scenario("the walls that the mouse has found outlive a reload", { timeout = 60 }, function(s)
  local world = s:load "systems/flood_fill.lua"
  s:never("touches anything", function() return world.mouse.collided end)
  s:run(10)
  local column, row, known = world.solver.state.mouse.column, world.solver.state.mouse.row, world.solver:map()
  local ok, message = s:reload("solver", { file = "flood_fill" })
  s:check(ok, message)
  s:check(world.solver:map() == known and #known > 33 * 33)
  s:run(0.1)
  s:check(world.solver.state.mouse.column == column and world.solver.state.mouse.row == row, "it goes on from there")
  s:eventually("knows it", { within = 50 }, function() return world.solver.state.known end)
  s:check(world.solver.state.known == 10)
end)

local race = { timeout = 300, sweep = { solver = { "flood_fill", "diagonal" }, maze = { "first", "second" } } }

scenario("a mouse takes the shortest way in a contest's maze, also on diagonals, with sensors that deviate by 5 %", race, function(s, p)
  local contest = s:maze("mazes/" .. p.maze .. ".txt")
  s:arena { contest }
  s:robot "mouse" { model = "raspimouse", pose = contest.pose, noise = 0.05 }
  local solver = s:behavior "solver" {
    script = p.solver,
    config = { home = contest.start, direction = contest.direction, goal = contest.goal, size = { contest.columns, contest.rows } },
  }
  s:connect("mouse.current_pose_out", "solver.pose")
  s:connect("mouse.ir_sensor_metre_out", "solver.ranges")
  s:connect("solver.target", "mouse.target_velocity_in")
  s:never("touches a wall", function() return s.mouse.collided end)
  s:eventually("is there", { within = 300 }, function() return solver.state.time end)
  s:check(solver.state.known == (p.maze == "first" and 15 or 14), "it knows the shortest way")
  local at, cell = s.mouse.truth.pose.position, 0.18
  local column, row = math.floor(at.x / cell + 0.5) + 1, math.floor(at.y / cell + 0.5) + 1
  local is_goal = false
  for i = 1, #contest.goal, 2 do is_goal = is_goal or (contest.goal[i] == column and contest.goal[i + 1] == row) end
  s:check(is_goal, "it is where it believes to be")
  if p.solver == "diagonal" then s:check(solver.state.time < 15, "the diagonals are short") end
end)

scenario("a maze whose goal can't be reached is reported", { timeout = 60 }, function(s)
  local closed = s:maze { rows = { "o---o---o---o", "|       | G |", "o   o   o---o", "| S |       |", "o---o---o---o" } }
  s:arena { closed }
  s:robot "mouse" { model = "raspimouse", pose = closed.pose }
  local solver = s:behavior "solver" { script = "flood_fill", config = { goal = closed.goal, size = { 3, 2 } } }
  s:connect("mouse.current_pose_out", "solver.pose")
  s:connect("mouse.ir_sensor_metre_out", "solver.ranges")
  s:connect("solver.target", "mouse.target_velocity_in")
  s:allow_error(solver)
  s:eventually("gives up", { within = 60 }, function() return solver.error end)
  s:check(solver.error:find("no way leads to the goal", 1, true), solver.error)
  s:check(not s.mouse.collided, "it has touched nothing")
end)
