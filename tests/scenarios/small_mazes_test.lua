--- The mice of the mazes in small ones: left_hand, flood_fill, diagonal, cell by cell.

local function is_in(mouse, column, row)
  local at = mouse.truth.pose.position
  return math.abs(at.x - (column - 1) * 0.18) < 0.02 and math.abs(at.y - (row - 1) * 0.18) < 0.02
end

--- The left hand leads it into a blind end and through a crossing: 8 cells, of which the shortest way has 6.
local small = {
  rows = {
    "o---o---o---o",
    "|           |",
    "o   o   o---o",
    "|   |       |",
    "o   o   o   o",
    "| S |   | G |",
    "o---o---o---o",
  },
}

--- The same seen in a mirror: it begins at the right, and turns the other way.
local mirrored = { rows = {} }
for i, row in ipairs(small.rows) do mirrored.rows[i] = row:reverse() end

local function in_small(s, script, config, rows)
  local maze = s:maze(rows or small)
  s:arena { maze }
  s:robot "mouse" { model = "raspimouse", pose = maze.pose }
  config.goal = config.goal or { 3, 1 }
  local solver = s:behavior "solver" { script = script, config = config }
  s:connect("mouse.current_pose_out", "solver.pose")
  s:connect("mouse.ir_sensor_metre_out", "solver.ranges")
  s:connect("solver.target", "mouse.target_velocity_in")
  s:never("touches a wall", function() return s.mouse.collided end)
  return solver
end

scenario("the left hand goes left before ahead before right before back", { timeout = 60 }, function(s)
  local solver = in_small(s, "left_hand", {})
  s:equal(solver.state.cells, 0)
  s:run(2)
  s:check(s:reload("solver", { file = "left_hand" }))
  s:eventually("is there", { within = 30 }, function() return solver.tasks.solve.status == "finished" end)
  s:run(0.5)
  s:check(is_in(s.mouse, 3, 1))
  s:equal(solver.state.cells, 8)
  s:equal({ solver.state.mouse.column, solver.state.mouse.row }, { 3, 1 })
end)

--- The way of each solver: column and row that it drives to, direction that it turns to.
local ways = {
  flood_fill = "1 1 1, 1 3 1, 1 3 0, 2 3 0, 2 3 3, 2 2 3, 2 2 0, 3 2 0, 3 2 3, 3 1 3",
  diagonal = "1 1 1, 1 3 1, 1 3 0, 1.5 3 0, 1.5 3 3.5, 3 1.5 3.5, 3 1.5 3, 3 1 3",
}
local mirrored_ways = {
  flood_fill = "3 1 1, 3 3 1, 3 3 2, 2 3 2, 2 3 3, 2 2 3, 2 2 2, 1 2 2, 1 2 3, 1 1 3",
  diagonal = "3 1 1, 3 3 1, 3 3 2, 2.5 3 2, 2.5 3 2.5, 1 1.5 2.5, 1 1.5 3, 1 1 3",
}

scenario("a mouse that has learned a small maze takes its shortest way", {
  timeout = 60,
  sweep = { solver = { "flood_fill", "diagonal" }, mirrored = { false, true } },
}, function(s, p)
  local from, to = p.mirrored and 3 or 1, p.mirrored and 1 or 3
  local solver = in_small(s, p.solver, { size = { 3, 3 }, home = { from, 1 }, goal = { to, 1 } }, p.mirrored and mirrored or small)
  s:eventually("knows it", { within = 60 }, function() return solver.state.known end)
  s:equal(solver.state.known, 6)
  s:equal(solver.state.time, nil)
  local begun, fastest, way = s:now(), 0, {}
  while not solver.state.time do
    s:run(0.01)
    fastest = math.max(fastest, solver.target.value.vx)
    local at = solver.state.mouse
    local now = ("%g %g %g"):format(at.column, at.row, at.direction)
    if way[#way] ~= now then way[#way + 1] = now end
  end
  s:equal(table.concat(way, ", "), (p.mirrored and mirrored_ways or ways)[p.solver])
  s:near(solver.state.time, s:now() - begun, 0.05)
  s:near(fastest, 0.4, 1e-9)
  s:equal(#solver:map(), 8 * 7 - 1, "7 lines")
end)

scenario("a goal of several cells is reached in the nearest", { timeout = 60 }, function(s)
  local solver = in_small(s, "flood_fill", { size = { 3, 3 }, goal = { 3, 1, 3, 2 } })
  s:eventually("is there", { within = 60 }, function() return solver.state.time end)
  s:equal(solver.state.known, 5)
  s:check(is_in(s.mouse, 3, 2))
end)

scenario("the mice of the mazes have their defaults", function(s)
  local function has(script, expected)
    local config = s:behavior(script, { script = script }).config
    for name, value in pairs(expected) do s:equal(config[name], value, name) end
    s:equal(#s.world[script]:map(), 34 * 33 - 1, "33 lines")
  end
  has("left_hand", { goal = { 8, 8 }, speed = 0.3 })
  for _, script in ipairs { "flood_fill", "diagonal" } do
    has(script, { goal = { 8, 8 }, home = { 1, 1 }, direction = 1, size = { 16, 16 }, speed = 0.3, fast = 0.4 })
  end
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
