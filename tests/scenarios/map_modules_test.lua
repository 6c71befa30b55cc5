--- The modules for maps: poses, grid, path, and what they say of arguments that are wrong.

local grid = require "nezumi.grid"
local path = require "nezumi.path"
local poses = require "nezumi.poses"

--- What a call says when it fails, with its line, which is to be one of this file.
local function said(f)
  local ok, message = pcall(f)
  local file, text = tostring(message):match("^(.-):%d+: (.*)$")
  return not ok and file and file:match("map_modules_test%.lua$") and text or "not refused here: " .. tostring(message)
end

local function equal(s, actual, expected) s:check(actual == expected, ("%s, not %s"):format(actual, expected)) end

local function near_pose(s, actual, x, y, heading)
  s:near(actual.position.x, x, 1e-12)
  s:near(actual.position.y, y, 1e-12)
  s:near(actual.heading, heading, 1e-12)
end

scenario("poses in the plane are composed, inverted and related", function(s)
  local robot = poses.plane(1, 2, math.pi / 2)
  near_pose(s, poses.compose(robot, poses.plane(3, 1, math.pi)), 0, 5, -math.pi / 2)
  near_pose(s, poses.compose(robot, poses.inverse(robot)), 0, 0, 0)
  near_pose(s, poses.relative(robot, poses.plane(1, 4, math.pi)), 2, 0, math.pi / 2)
  local point = poses.transform(robot, { x = 1, y = 0 })
  s:near(point.x, 1, 1e-12)
  s:near(point.y, 3, 1e-12)
  local back = poses.to_local(robot, point)
  s:near(back.x, 1, 1e-12)
  s:near(back.y, 0, 1e-12)
end)

--- Angles that are no special ones, and those where x points straight up and down.
local in_space = {
  poses.space(1, -2, 0.5, 0.3, -0.4, 2.9),
  poses.space(0, 1, 2, -1.2, 1.1, -0.7),
  poses.space(3, 0, 0, 0.4, math.pi / 2, 1),
  poses.space(0, 0, -1, -0.3, -math.pi / 2, 0.2),
}

scenario("poses in space turn by yaw, then pitch, then roll", function(s)
  local point = poses.transform(poses.space(0, 0, 1, 0, 0, math.pi / 2), { x = 1, y = 0, z = 0 })
  s:near(point.x, 0, 1e-12)
  s:near(point.y, 1, 1e-12)
  s:near(point.z, 1, 1e-12)
  s:near(poses.transform(poses.space(0, 0, 0, 0, math.pi / 2, 0), { x = 1, y = 0, z = 0 }).z, -1, 1e-12, "nose down")
  s:near(poses.transform(poses.space(0, 0, 0, math.pi / 2, 0, 0), { x = 0, y = 1, z = 0 }).z, 1, 1e-12, "left side up")
end)

scenario("a pose composed in space moves points as its parts do, one after the other", function(s)
  local point = { x = 0.3, y = -0.2, z = 0.7 }
  for _, a in ipairs(in_space) do
    for _, b in ipairs(in_space) do
      local at_once, in_turn = poses.transform(poses.compose(a, b), point), poses.transform(a, poses.transform(b, point))
      local there_and_back = poses.transform(poses.relative(a, b), point)
      local other_way = poses.to_local(a, poses.transform(b, point))
      for _, axis in ipairs { "x", "y", "z" } do
        s:near(at_once[axis], in_turn[axis], 1e-9)
        s:near(there_and_back[axis], other_way[axis], 1e-9)
      end
    end
    local nothing = poses.compose(a, poses.inverse(a))
    s:near(nothing.position.x, 0, 1e-9)
    s:near(nothing.orientation.p, 0, 1e-9)
  end
end)

scenario("a value that is not a pose is refused", function(s)
  local a_pose = " expected a pose: { position = { x, y }, heading }, or position with z and orientation = { r, p, y }"
  equal(s, said(function() poses.inverse { x = 1, y = 2, heading = 0 } end), "poses.inverse" .. a_pose)
  equal(s, said(function() poses.transform(nil, {}) end), "poses.transform" .. a_pose)
  equal(s, said(function() poses.transform(poses.plane(0, 0, 0), { 1, 2 }) end), "poses.transform expected a point: { x, y }")
  equal(s, said(function() poses.to_local(in_space[1], { x = 1, y = 2 }) end), "poses.to_local expected a point: { x, y, z }")
  equal(s, said(function() poses.compose(poses.plane(0, 0, 0), in_space[1]) end),
    "poses.compose expected two poses in the plane or two in space, got one of each")
  equal(s, said(function() poses.plane(1, 2) end), "poses.plane: heading expected a finite number, got nothing")
  equal(s, said(function() poses.space(1, 2) end), "poses.space: z expected a finite number, got nothing")
end)

scenario("a grid knows the cell of a place and the place of a cell", function(s)
  local map = grid { columns = 4, rows = 3, cell = 0.5, x = -1, y = 0 }
  local column, row = map:cell_at(-1, 0)
  s:check(column == 1 and row == 1)
  column, row = map:cell_at(0.99, 1.49)
  s:check(column == 4 and row == 3)
  s:check(map:cell_at(1, 0.5) == nil and map:cell_at(0, 1.5) == nil and map:cell_at(-1.01, 0) == nil)
  local x, y = map:centre(4, 3)
  s:near(x, 0.75, 1e-12)
  s:near(y, 1.25, 1e-12)
end)

scenario("a ray makes the cells on its way free, and the last one occupied where it hit", function(s)
  local map = grid { columns = 8, rows = 4, cell = 0.1 }
  map:mark_ray(0.05, 0.05, 0.65, 0.35, true)
  equal(s, map:text(), "     .# \n   ...  \n ...    \n..      ")
  map:mark_ray(0.75, 0.35, 0.75, 0.05, false)
  equal(s, map:text(), "     .#.\n   ... .\n ...   .\n..     .")
  s:near(map:evidence(7, 4), 0.85, 1e-12)
  s:near(map:evidence(8, 1), -0.4, 1e-12)
  s:near(map:evidence(1, 4), 0, 0)
end)

scenario("a ray marks each cell that it passes, in every direction", function(s)
  for i = 0, 35 do
    local angle = 2 * math.pi * (i + 0.3) / 36
    local map = grid { columns = 41, rows = 41, cell = 0.05 }
    local to_x, to_y = 1.025 + 0.9 * math.cos(angle), 1.025 + 0.9 * math.sin(angle)
    map:mark_ray(1.025, 1.025, to_x, to_y, true)
    local passed = 0
    for part = 0, 2000 do
      local column, row = map:cell_at(1.025 + (to_x - 1.025) * part / 2000, 1.025 + (to_y - 1.025) * part / 2000)
      s:check(map:evidence(column, row) ~= 0, ("at %g of ray %d"):format(part / 2000, i))
    end
    for index = 1, 41 * 41 do
      if map.memory.cells[index] ~= 0 then passed = passed + 1 end
    end
    local column, row = map:cell_at(to_x, to_y)
    s:check(map:evidence(column, row) > 0)
    s:check(passed == 1 + math.abs(column - 21) + math.abs(row - 21), "and no other")
  end
end)

scenario("rays from outside, to the outside and past the grid", function(s)
  local map = grid { columns = 3, rows = 3, cell = 1 }
  map:mark_ray(-5, 1.5, 9, 1.5, true)
  equal(s, map:text(), "   \n...\n   ")
  map:mark_ray(-1, 5, 5, 8, true)
  map:mark_ray(-1, -1, -1, 5, true)
  equal(s, map:text(), "   \n...\n   ")
  map:mark_ray(2.5, 0.5, 2.5, 0.5, true)
  s:check(map:evidence(3, 1) > 0, "a ray of no length hits where it begins")
end)

scenario("evidence is bounded, so that the world may change", function(s)
  local map = grid { columns = 1, rows = 1, cell = 1 }
  for _ = 1, 100 do map:mark_ray(0.5, 0.5, 0.5, 0.5, true) end
  s:near(map:evidence(1, 1), 3.5, 0)
  for _ = 1, 9 do map:mark_ray(0.5, 0.5, 0.5, 0.5, false) end
  s:check(map:evidence(1, 1) < 0)
  map:set(0.5, 0.5, true)
  s:check(map:evidence(1, 1) > 0)
  map:set(5, 5, true)
end)

scenario("the memory of a grid outlives the grid", function(s)
  local memory = {}
  grid({ columns = 2, rows = 1, cell = 1 }, memory):set(1.5, 0.5, true)
  equal(s, grid({ columns = 2, rows = 1, cell = 1 }, memory):text(), " #")
  equal(s, grid({ columns = 3, rows = 1, cell = 1 }, memory):text(), "   ")
end)

scenario("wrong options of a grid are refused", function(s)
  equal(s, said(function() grid { columns = 3, rows = 3 } end), "grid: cell expected a number above 0, got nothing")
  equal(s, said(function() grid { columns = 0, rows = 3, cell = 1 } end), "grid: columns expected a whole number from 1 to 250000, got 0")
  equal(s, said(function() grid { columns = 501, rows = 500, cell = 1 } end),
    "grid: the number of cells expected a whole number from 1 to 250000, got 250500")
  equal(s, said(function() grid { width = 3 } end), "grid has no 'width': it has columns, rows, cell, x, y")
  local map = grid { columns = 3, rows = 3, cell = 1 }
  equal(s, said(function() map:evidence(4, 1) end), "grid: column expected a whole number from 1 to 3, got 4")
  equal(s, said(function() map:mark_ray(0, 0, 1, 1) end), "grid: hit expected a boolean, got nothing")
end)

--- A grid of cells of 1 m of a drawing, the largest y first; what is no `#` is free, spaces are unknown.
local function drawn(...)
  local lines = { ... }
  local map = grid { columns = #lines[1], rows = #lines, cell = 1 }
  for i, line in ipairs(lines) do
    for column = 1, #line do
      local what = line:sub(column, column)
      if what ~= " " then map:set(column - 0.5, #lines - i + 0.5, what == "#") end
    end
  end
  return map
end

scenario("the shortest way goes round walls and cuts no corners", function(s)
  local map = drawn(
    ".....",
    ".###.",
    ".#...",
    ".#.#.",
    "...#.")
  local way = path.find(map, { x = 2.5, y = 2.5 }, { x = 0.5, y = 2.5 })
  local text = {}
  for i, point in ipairs(way) do text[i] = ("%g,%g"):format(point.x, point.y) end
  equal(s, table.concat(text, " "), "2.5,2.5 2.5,0.5 0.5,0.5 0.5,2.5")
  s:near(path.length(way), 6, 1e-12)
  s:near(path.length(path.find(drawn("....", "....", "...."), { x = 0.5, y = 0.5 }, { x = 3.5, y = 2.5 })),
    1 + 2 * math.sqrt(2), 1e-12, "diagonals on free ground")
end)

scenario("a way begins and ends at the places themselves", function(s)
  local way = path.find(drawn("..."), { x = 0.1, y = 0.3 }, { x = 2.9, y = 0.8 })
  s:check(#way == 2)
  s:near(way[1].x, 0.1, 0)
  s:near(way[2].y, 0.8, 0)
  s:check(#path.find(drawn("."), { x = 0.1, y = 0.3 }, { x = 0.2, y = 0.3 }) == 2)
end)

scenario("clearance keeps off walls, and lets a robot leave one", function(s)
  local map = drawn(
    ".......",
    ".......",
    "...#...",
    ".......",
    ".......")
  s:near(path.length(path.find(map, { x = 0.5, y = 2.5 }, { x = 6.5, y = 2.5 })), 4 + 2 * math.sqrt(2), 1e-12)
  local wide = path.find(map, { x = 0.5, y = 2.5 }, { x = 6.5, y = 2.5 }, { clearance = 1.5 })
  s:near(path.length(wide), 6 + 2 * math.sqrt(2), 1e-12)
  s:check(path.find(map, { x = 2.5, y = 2.5 }, { x = 0.5, y = 2.5 }, { clearance = 1.5 }), "the start is not asked")
  local way, reason = path.find(map, { x = 0.5, y = 2.5 }, { x = 3.5, y = 3.5 }, { clearance = 1 })
  s:check(way == nil)
  equal(s, reason, "the goal is blocked")
end)

scenario("where there is no way it says why", function(s)
  local map = drawn(". .", "###", "...")
  local function reason(from, to, options) return select(2, path.find(map, from, to, options)) end
  equal(s, reason({ x = 0.5, y = 0.5 }, { x = 0.5, y = 2.5 }), "there is no way")
  equal(s, reason({ x = 0.5, y = 0.5 }, { x = 0.5, y = 1.5 }), "the goal is blocked")
  equal(s, reason({ x = 3.5, y = 0.5 }, { x = 0.5, y = 0.5 }), "the start is outside of the grid")
  equal(s, reason({ x = 0.5, y = 0.5 }, { x = 0.5, y = -1 }), "the goal is outside of the grid")
  s:check(path.find(map, { x = 0.5, y = 2.5 }, { x = 2.5, y = 2.5 }), "through the unknown")
  equal(s, reason({ x = 0.5, y = 2.5 }, { x = 2.5, y = 2.5 }, { unknown = "blocked" }), "there is no way")
end)

scenario("ways through random grids are as short as those of a search in all directions", function(s)
  for _ = 1, 20 do
    local lines = {}
    for row = 1, 12 do
      local line = {}
      for column = 1, 12 do line[column] = math.random() < 0.3 and "#" or "." end
      lines[row] = table.concat(line)
    end
    local map = drawn(table.unpack(lines))
    map:set(0.5, 0.5, false)
    map:set(11.5, 11.5, false)
    -- Bellman and Ford: lengths that are shortened until none can be.
    local length, shortened = { [1] = 0 }, true
    local function free(column, row)
      return column >= 1 and column <= 12 and row >= 1 and row <= 12 and map:evidence(column, row) < 0
    end
    while shortened do
      shortened = false
      for row = 1, 12 do
        for column = 1, 12 do
          local here = length[(row - 1) * 12 + column]
          for dx = -1, here and 1 or -2 do
            for dy = -1, 1 do
              if free(column + dx, row + dy) and free(column + dx, row) and free(column, row + dy) then
                local index, sum = (row + dy - 1) * 12 + column + dx, here + math.sqrt(dx * dx + dy * dy)
                if sum < (length[index] or math.huge) - 1e-9 then length[index], shortened = sum, true end
              end
            end
          end
        end
      end
    end
    local way = path.find(map, { x = 0.5, y = 0.5 }, { x = 11.5, y = 11.5 })
    s:check((way ~= nil) == (length[144] ~= nil))
    if way then s:near(path.length(way), length[144], 1e-6) end
  end
end)

scenario("the point to steer for lies ahead on the way", function(s)
  local way = { { x = 0, y = 0 }, { x = 2, y = 0 }, { x = 2, y = 2 } }
  local function ahead(x, y, distance)
    local point = path.ahead(way, { x = x, y = y }, distance)
    return ("%g,%g"):format(point.x, point.y)
  end
  equal(s, ahead(0.5, 0.3, 0.5), "1,0")
  equal(s, ahead(1.5, -0.3, 1), "2,0.5")
  equal(s, ahead(-3, 0, 0.25), "0.25,0")
  equal(s, ahead(2, 1.5, 9), "2,2")
  equal(s, ahead(1, 0, 0), "1,0")
  local only = path.ahead({ { x = 4, y = 5 } }, { x = 0, y = 0 }, 1)
  s:check(only.x == 4 and only.y == 5)
end)

scenario("a value that is not a path or a point is refused", function(s)
  local map = drawn("...")
  equal(s, said(function() path.find(map, { 1, 2 }, { x = 1, y = 1 }) end), "path.find: from expected a point: { x, y }")
  equal(s, said(function() path.find(map, { x = 1, y = 1 }, { x = 1, y = 1 }, { margin = 1 }) end),
    "path.find: options has no 'margin': it has clearance, unknown")
  equal(s, said(function() path.find(map, { x = 1, y = 1 }, { x = 1, y = 1 }, { unknown = 1 }) end),
    "path.find: unknown expected 'free' or 'blocked', got 1")
  equal(s, said(function() path.ahead({}, { x = 1, y = 1 }, 1) end),
    ("path.ahead: the number of points expected a whole number from 1 to %d, got 0"):format(math.maxinteger))
  equal(s, said(function() path.ahead({ { x = 1, y = 1 } }, { x = 1, y = 1 }, -1) end),
    "path.ahead: distance expected a number from 0 on, got -1")
end)
