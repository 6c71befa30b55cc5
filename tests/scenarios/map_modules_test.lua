--- The modules for maps: grid, path, and what they say of arguments that are wrong.

local grid = require "nezumi.grid"
local path = require "nezumi.path"

--- What a call says when it fails, with its line, which is to be one of this file.
local function said(f)
  local ok, message = pcall(f)
  local file, text = tostring(message):match("^(.-):%d+: (.*)$")
  return not ok and file and file:match("map_modules_test%.lua$") and text or "not refused here: " .. tostring(message)
end

local function equal(s, actual, expected) s:check(actual == expected, ("%s, not %s"):format(actual, expected)) end

scenario("a grid knows the cell of a place and the place of a cell", function(s)
  local map = grid { columns = 4, rows = 3, cell = 0.5, x = -1, y = 2 }
  local column, row = map:cell_at(-1, 2)
  s:check(column == 1 and row == 1)
  column, row = map:cell_at(0.99, 3.49)
  s:check(column == 4 and row == 3)
  s:check(map:cell_at(1, 2.5) == nil and map:cell_at(0, 3.5) == nil and map:cell_at(-1.01, 2) == nil and map:cell_at(0, 1.99) == nil)
  local left, below = map:centre(1, 1)
  s:near(left, -0.75, 1e-12)
  s:near(below, 2.25, 1e-12)
  local x, y = map:centre(4, 3)
  s:near(x, 0.75, 1e-12)
  s:near(y, 3.25, 1e-12)
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
  local shifted = grid { columns = 8, rows = 4, cell = 0.1, x = 5, y = -3 }
  shifted:mark_ray(5.05, -2.95, 5.65, -2.65, true)
  equal(s, shifted:text(), "     .# \n   ...  \n ...    \n..      ")
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
  map:mark_ray(-1, 0.5, -1, 0.5, true)
  map:mark_ray(4, 0.5, 4, 0.5, true)
  map:mark_ray(0.5, -1, 0.5, -1, true)
  map:mark_ray(0.5, 4, 0.5, 4, true)
  equal(s, map:text(), "   \n...\n   ")
  map:mark_ray(2.5, 0.5, 2.5, 0.5, true)
  s:check(map:evidence(3, 1) > 0, "a ray of no length hits where it begins")
  for _, ends in ipairs { { -1, -0.5, 4, 3 }, { 4, 3, -1, -0.5 } } do
    local through = grid { columns = 3, rows = 3, cell = 1 }
    through:mark_ray(ends[1], ends[2], ends[3], ends[4], true)
    equal(s, through:text(), "  .\n ..\n.. ")
  end
  for _, border in ipairs { 0, 3 } do
    local along = grid { columns = 3, rows = 3, cell = 1 }
    along:mark_ray(-1, border, 5, border, false)
    along:mark_ray(border, -1, border, 5, false)
    equal(s, along:text(), border == 0 and ".  \n.  \n..." or "...\n  .\n  .", "along the border itself")
  end
end)

scenario("evidence is bounded, so that the world may change", function(s)
  local map = grid { columns = 1, rows = 1, cell = 1 }
  for _ = 1, 100 do map:mark_ray(0.5, 0.5, 0.5, 0.5, true) end
  s:near(map:evidence(1, 1), 3.5, 0)
  for _ = 1, 9 do map:mark_ray(0.5, 0.5, 0.5, 0.5, false) end
  s:check(map:evidence(1, 1) < 0)
  for _ = 1, 100 do map:mark_ray(0.5, 0.5, 0.5, 0.5, false) end
  s:near(map:evidence(1, 1), -2, 0)
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
  equal(s, said(function() grid() end), "grid expected a table, got nothing")
  equal(s, said(function() grid { width = 3 } end), "grid has no 'width': it has columns, rows, cell, x, y")
  equal(s, said(function() grid { columns = 1, rows = 0, cell = 1 } end), "grid: rows expected a whole number from 1 to 250000, got 0")
  equal(s, said(function() grid { columns = 1, rows = 1, cell = 1, x = {} } end), "grid: x expected a finite number, got table")
  equal(s, said(function() grid { columns = 1, rows = 1, cell = 1, y = {} } end), "grid: y expected a finite number, got table")
  equal(s, said(function() grid({ columns = 1, rows = 1, cell = 1 }, 1) end), "grid: memory expected a table, got 1")
  local map = grid { columns = 3, rows = 3, cell = 1 }
  for _, name in ipairs { "evidence", "centre" } do
    for _, wrong in ipairs { 0, 4, 1.5 } do
      local expected = " expected a whole number from 1 to 3, got " .. wrong
      equal(s, said(function() map[name](map, wrong, 1) end), "grid: column" .. expected)
      equal(s, said(function() map[name](map, 1, wrong) end), "grid: row" .. expected)
    end
  end
  -- The last argument is a boolean, all before are numbers.
  for name, arguments in pairs {
    cell_at = { "x", "y" }, set = { "x", "y", "occupied" }, mark_ray = { "x", "y", "to_x", "to_y", "hit" },
  } do
    for i, argument in ipairs(arguments) do
      local values = { 0, 0, name == "set" or 0, 0, true }
      values[i] = "1"
      local kind = (argument == "occupied" or argument == "hit") and "boolean" or "finite number"
      equal(s, said(function() map[name](map, table.unpack(values)) end), ("grid: %s expected a %s, got string"):format(argument, kind))
    end
  end
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

scenario("exactly the cells within the clearance of an occupied cell are blocked, for any size of cells", function(s)
  for _, clearance in ipairs { 0, 1, 1.5, 3 } do
    for _, place in ipairs { { 4, 4 }, { 1, 1 }, { 7, 2 } } do
      local map = grid { columns = 7, rows = 7, cell = 0.5 }
      map:mark_ray(0.5 * place[1] - 0.25, 0.5 * place[2] - 0.25, 0.5 * place[1] - 0.25, 0.5 * place[2] - 0.25, true) -- seen once
      for column = 1, 7 do
        for row = 1, 7 do
          local goal = { x = 0.5 * column - 0.25, y = 0.5 * row - 0.25 }
          local _, reason = path.find(map, goal, goal, { clearance = clearance / 2 })
          local is_near = (column - place[1]) ^ 2 + (row - place[2]) ^ 2 <= clearance ^ 2
          s:equal(reason, is_near and "the goal is blocked" or nil)
        end
      end
    end
  end
end)

scenario("a search without a result gives the reason", function(s)
  local map = drawn(". .", "###", "...")
  local function reason(from, to, options) return select(2, path.find(map, from, to, options)) end
  equal(s, reason({ x = 0.5, y = 0.5 }, { x = 0.5, y = 2.5 }), "there is no way")
  equal(s, reason({ x = 0.5, y = 0.5 }, { x = 0.5, y = 1.5 }), "the goal is blocked")
  equal(s, reason({ x = 3.5, y = 0.5 }, { x = 0.5, y = 0.5 }), "the start is outside of the grid")
  equal(s, reason({ x = 0.5, y = 0.5 }, { x = 0.5, y = -1 }), "the goal is outside of the grid")
  s:check(path.find(map, { x = 0.5, y = 2.5 }, { x = 2.5, y = 2.5 }), "through the unknown")
  equal(s, reason({ x = 0.5, y = 2.5 }, { x = 2.5, y = 2.5 }, { unknown = "blocked" }), "there is no way")
end)

scenario("the same one of several equally short ways is chosen each time", function(s)
  local map = drawn(".......", ".......", ".......", ".......", ".......")
  local function corners(from_x, from_y, to_x, to_y)
    local text = {}
    for i, point in ipairs(path.find(map, { x = from_x, y = from_y }, { x = to_x, y = to_y })) do
      text[i] = ("%g,%g"):format(point.x, point.y)
    end
    return table.concat(text, " ")
  end
  equal(s, corners(0.5, 0.5, 6.5, 2.5), "0.5,0.5 4.5,0.5 6.5,2.5")
  equal(s, corners(6.5, 2.5, 0.5, 0.5), "6.5,2.5 2.5,2.5 0.5,0.5")
  equal(s, corners(0.5, 4.5, 2.5, 0.5), "0.5,4.5 0.5,2.5 2.5,0.5")
end)

scenario("ways through random grids are as short as those of a search in all directions", function(s)
  for _ = 1, 60 do
    local lines = {}
    for row = 1, 12 do
      local line = {}
      for column = 1, 12 do line[column] = math.random() < 0.3 and "#" or "." end
      lines[row] = table.concat(line)
    end
    local map = drawn(table.unpack(lines))
    local from = { x = math.random(12) - 0.5, y = math.random(12) - 0.5 }
    local to = { x = math.random(12) - 0.5, y = math.random(12) - 0.5 }
    map:set(from.x, from.y, false)
    map:set(to.x, to.y, false)
    local function index_of(point) return 12 * (point.y // 1) + point.x // 1 + 1 end
    -- Bellman and Ford: lengths that are shortened until none can be.
    local length, shortened = { [index_of(from)] = 0 }, true
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
    local way, shortest = path.find(map, from, to), length[index_of(to)]
    s:check((way ~= nil) == (shortest ~= nil))
    if way then s:near(path.length(way), shortest, 1e-6) end
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
  equal(s, ahead(2.3, 1, 0.5), "2,1.5")
  equal(s, ahead(2.5, -0.5, 0.5), "2,0.5")
  -- Legs of 5 m and 13 m.
  way = { { x = 1, y = 2 }, { x = 4, y = 6 }, { x = 16, y = 11 } }
  equal(s, ahead(1.4, 4.2, 1), "2.8,4.4")
  equal(s, ahead(1.4, 4.2, 9.5), "10,8.5")
  equal(s, ahead(9.5, 9.7, 2.6), "12.4,9.5")
  equal(s, ahead(20, 12, 1), "16,11")
  way = { { x = 1, y = 1 }, { x = 1, y = 1 }, { x = 3, y = 1 } }
  equal(s, ahead(1, 1, 0.5), "1.5,1")
  local only = path.ahead({ { x = 4, y = 5 } }, { x = 0, y = 0 }, 1)
  s:check(only.x == 4 and only.y == 5)
end)

scenario("a value that is not a path or a point is refused", function(s)
  local map, good = drawn("..."), { x = 1, y = 1 }
  for _, wrong in ipairs { { 1, 2 }, { x = 1 }, { y = 1 }, 1 } do
    equal(s, said(function() path.find(map, wrong, good) end), "path.find: from expected a point: { x, y }")
    equal(s, said(function() path.find(map, good, wrong) end), "path.find: to expected a point: { x, y }")
    equal(s, said(function() path.ahead({ good }, wrong, 1) end), "path.ahead: position expected a point: { x, y }")
  end
  equal(s, said(function() path.find(1, good, good) end), "path.find: grid expected a table, got 1")
  equal(s, said(function() path.find(map, good, good, { margin = 1 }) end),
    "path.find: options has no 'margin': it has clearance, unknown")
  equal(s, said(function() path.find(map, good, good, { clearance = -1 }) end),
    "path.find: clearance expected a number from 0 on, got -1")
  equal(s, said(function() path.find(map, good, good, { unknown = 1 }) end),
    "path.find: unknown expected 'free' or 'blocked', got 1")
  equal(s, said(function() path.length(1) end), "path.length: points expected a table, got 1")
  equal(s, said(function() path.ahead(1, good, 1) end), "path.ahead: points expected a table, got 1")
  equal(s, said(function() path.ahead({}, good, 1) end),
    ("path.ahead: the number of points expected a whole number from 1 to %d, got 0"):format(math.maxinteger))
  equal(s, said(function() path.ahead({ good }, good, -1) end), "path.ahead: distance expected a number from 0 on, got -1")
end)
