--- Occupancy grids: what is known of the cells of a floor, from rays that were seen to pass and to hit.
--- A cell's evidence is the logarithm of the odds that it is occupied: 0 is unknown, above is occupied, below is free.
--- What a grid knows is plain data in `memory`: a table in `state` lets it live through a reload.

local expect = require "nezumi.expect"

-- Evidence of one ray, and what a cell gathers at most: those of OctoMap (Hornung et al., Autonomous Robots 2013).
local HIT, PASS = 0.85, -0.4
local LEAST, MOST = -2.0, 3.5
local MOST_CELLS = 250000

---@class nezumi.Grid
---@field columns integer along x
---@field rows integer along y
---@field cell number edge of a cell [m]
---@field x number of the grid's corner with the least x and y [m]
---@field y number
---@field memory { cells: number[] } evidence, row by row
local Grid = {}
Grid.__index = Grid

--- The column and row of the cell at a place; nil outside of the grid.
---@param x number [m]
---@param y number [m]
---@return integer? column
---@return integer? row
function Grid:cell_at(x, y)
  expect.number("grid: x", x)
  expect.number("grid: y", y)
  local column, row = (x - self.x) // self.cell + 1, (y - self.y) // self.cell + 1
  if column < 1 or column > self.columns or row < 1 or row > self.rows then return nil end
  return math.tointeger(column), math.tointeger(row)
end

--- The middle of a cell [m].
---@param column integer
---@param row integer
---@return number x
---@return number y
function Grid:centre(column, row)
  expect.whole("grid: column", column, 1, self.columns)
  expect.whole("grid: row", row, 1, self.rows)
  return self.x + (column - 0.5) * self.cell, self.y + (row - 0.5) * self.cell
end

--- What is known of a cell: above 0 it is occupied, below 0 free, at 0 unknown.
---@param column integer
---@param row integer
---@return number
function Grid:evidence(column, row)
  expect.whole("grid: column", column, 1, self.columns)
  expect.whole("grid: row", row, 1, self.rows)
  return self.memory.cells[(row - 1) * self.columns + column]
end

--- Says of the cell at a place, for certain, that it is occupied or free; nothing outside of the grid.
---@param x number [m]
---@param y number [m]
---@param occupied boolean
function Grid:set(x, y, occupied)
  expect.kind("grid: occupied", occupied, "boolean")
  expect.number("grid: x", x)
  expect.number("grid: y", y)
  local column, row = self:cell_at(x, y)
  if column then self.memory.cells[(row - 1) * self.columns + column] = occupied and MOST or LEAST end
end

-- The part of a line from `from` on, of length 1 for the whole, that lies within [low, high] along one axis.
local function clip(from, step, low, high, first, last)
  if step == 0 then
    if from < low or from > high then return 1, 0 end
    return first, last
  end
  local a, b = (low - from) / step, (high - from) / step
  return math.max(first, math.min(a, b)), math.min(last, math.max(a, b))
end

--- A ray that was seen from (x, y) to (to_x, to_y): the cells on its way are free, the last one is occupied if it hit
--- something there. What lies outside of the grid is left out.
---@param x number [m]
---@param y number [m]
---@param to_x number [m]
---@param to_y number [m]
---@param hit boolean
function Grid:mark_ray(x, y, to_x, to_y, hit)
  expect.number("grid: x", x)
  expect.number("grid: y", y)
  expect.number("grid: to_x", to_x)
  expect.number("grid: to_y", to_y)
  expect.kind("grid: hit", hit, "boolean")
  local columns, rows, cells = self.columns, self.rows, self.memory.cells
  -- In cells, from the corner.
  local from_x, from_y = (x - self.x) / self.cell, (y - self.y) / self.cell
  local step_x, step_y = (to_x - x) / self.cell, (to_y - y) / self.cell
  local first, last = clip(from_x, step_x, 0, columns, 0, 1)
  first, last = clip(from_y, step_y, 0, rows, first, last)
  if first > last then return end

  -- From cell to cell (Amanatides and Woo, Eurographics 1987): the border that is met first is crossed.
  local function inside(value, count) return math.tointeger(math.max(0, math.min(count - 1, value // 1))) end
  local column, row = inside(from_x + first * step_x, columns), inside(from_y + first * step_y, rows)
  local end_column, end_row = inside(from_x + last * step_x, columns), inside(from_y + last * step_y, rows)
  local turn_x, turn_y = step_x > 0 and 1 or -1, step_y > 0 and 1 or -1
  local function border(at, from, step) return (step > 0 and at + 1 - from or at - from) / step end
  local next_x, next_y = border(column, from_x, step_x), border(row, from_y, step_y)
  -- So many borders lie in between, whatever rounding does.
  local crossings = math.abs(end_column - column) + math.abs(end_row - row)
  local hits_within = hit and last >= 1
  for crossed = 0, crossings do
    local index = row * columns + column + 1
    local change = hits_within and crossed == crossings and HIT or PASS
    cells[index] = math.max(LEAST, math.min(MOST, cells[index] + change))
    if row == end_row or (next_x < next_y and column ~= end_column) then
      column = column + turn_x
      next_x = border(column, from_x, step_x)
    else
      row = row + turn_y
      next_y = border(row, from_y, step_y)
    end
  end
end

--- The grid as lines of text, the largest y first: `#` occupied, `.` free, a space unknown.
---@return string
function Grid:text()
  local lines = {}
  for row = self.rows, 1, -1 do
    local line = {}
    for column = 1, self.columns do
      local evidence = self.memory.cells[(row - 1) * self.columns + column]
      line[column] = evidence > 0 and "#" or evidence < 0 and "." or " "
    end
    lines[#lines + 1] = table.concat(line)
  end
  return table.concat(lines, "\n")
end

--- `grid({ columns =, rows =, cell =, x =, y = }, state.map)`: of `columns` by `rows` cells (at most 250 000) with edges
--- of `cell` [m]; `x` and `y` [m] are its corner's, 0 when they are left out. All is unknown at first.
---@param options { columns: integer, rows: integer, cell: number, x: number?, y: number? }
---@param memory table?
---@return nezumi.Grid
local function new(options, memory)
  expect.fields("grid", options, { "columns", "rows", "cell", "x", "y" })
  local self = setmetatable({}, Grid)
  self.columns = expect.whole("grid: columns", options.columns, 1, MOST_CELLS)
  self.rows = expect.whole("grid: rows", options.rows, 1, MOST_CELLS)
  local count = self.columns * self.rows
  expect.whole("grid: the number of cells", count, 1, MOST_CELLS)
  self.cell = expect.positive("grid: cell", options.cell)
  self.x = expect.number("grid: x", options.x or 0)
  self.y = expect.number("grid: y", options.y or 0)
  self.memory = expect.kind("grid: memory", memory or {}, "table")
  local cells = self.memory.cells
  if type(cells) ~= "table" or #cells ~= count then
    cells = {}
    for i = 1, count do cells[i] = 0 end
    self.memory.cells = cells
  end
  return self
end

return new
