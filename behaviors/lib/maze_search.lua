--- How a mouse finds the shortest way through a maze that it does not know: flood fill. `explore` takes time: it is for tasks.

---@class MazeSearch
---@field mouse MazeMouse
local Search = {}
Search.__index = Search

local function key(column, row) return row * 100 + column end

--- How many cells it is from each cell to the nearest of these, through passages that are known, or also through those
--- that may be.
local function flood(mouse, cells, only_known)
  local distances, queue = {}, {}
  for i, cell in ipairs(cells) do
    distances[key(cell[1], cell[2])], queue[i] = 0, cell
  end
  for _, cell in ipairs(queue) do -- which grows meanwhile
    for direction = 0, 3 do
      local wall = mouse:wall(cell[1], cell[2], direction)
      local column, row = mouse:beside(cell[1], cell[2], direction)
      local is_open = wall == false or (wall == nil and not only_known)
      if column and is_open and not distances[key(column, row)] then
        distances[key(column, row)] = distances[key(cell[1], cell[2])] + 1
        queue[#queue + 1] = { column, row }
      end
    end
  end
  return distances
end

--- The direction that leads nearer, straight ahead where that is as good.
local function downhill(mouse, distances, column, row, ahead)
  local here = distances[key(column, row)]
  if not here then return nil end
  for _, turn in ipairs { 0, 1, 3, 2 } do
    local direction = (ahead + turn) % 4
    local next_column, next_row = mouse:beside(column, row, direction)
    if next_column and mouse:wall(column, row, direction) == false and distances[key(next_column, next_row)] == here - 1 then
      return direction
    end
  end
end

local function is_among(cells, column, row)
  for _, cell in ipairs(cells) do
    if cell[1] == column and cell[2] == row then return true end
  end
  return false
end

--- Drives to the nearest of these cells; what it learns on the way may change the way.
function Search:go(cells)
  local mouse, at = self.mouse, self.mouse.memory
  while not is_among(cells, at.column, at.row) do
    local direction = downhill(mouse, flood(mouse, cells, false), at.column, at.row, at.direction)
    if not direction then error("no way leads to the goal: are start, goal and size those of this maze?", 0) end
    mouse:turn(direction)
    mouse:forward(1)
  end
end

--- Drives to a goal and back until no passage that it has not seen can make the way shorter. Returns its cells.
function Search:explore()
  repeat
    self:go(self.goals)
    self:go { self.start }
    local start = key(self.start[1], self.start[2])
    local known = flood(self.mouse, self.goals, true)[start]
  until known == flood(self.mouse, self.goals, false)[start]
  return flood(self.mouse, self.goals, true)[key(self.start[1], self.start[2])]
end

--- The shortest known way from where the mouse is: a list of directions, one for each cell.
function Search:way()
  local at, distances = self.mouse.memory, flood(self.mouse, self.goals, true)
  local column, row, ahead, way = at.column, at.row, at.direction, {}
  while distances[key(column, row)] > 0 do
    ahead = downhill(self.mouse, distances, column, row, ahead)
    way[#way + 1] = ahead
    column, row = self.mouse:beside(column, row, ahead)
  end
  return way
end

--- `maze_search(mouse, start, goals)`: start is a column and a row, goals one or several of them: { 8, 8, 9, 8 }.
return function(mouse, start, goals)
  local cells = {}
  for i = 1, #goals - 1, 2 do cells[#cells + 1] = { goals[i], goals[i + 1] } end
  return setmetatable({ mouse = mouse, start = { start[1], start[2] }, goals = cells }, Search)
end
