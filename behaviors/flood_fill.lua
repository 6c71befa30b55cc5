--- Learns a maze, then takes the shortest way through it: flood fill, as the mice of the contests do.

local maze_mouse = require "maze_mouse"

local pose   = input("pose", "TimedPose2D", "where the wheels say that the mouse is")
local ranges = input("ranges", "TimedDoubleSeq", "distances [m]: right front, right side, left side, left front")
local target = output("target", "TimedVelocity2D", "target velocity")

param("goal", { 8, 8 }, { min_size = 2, max_size = 2, min = 1, max = 16, doc = "column and row of the cell to find" })
param("speed", 0.3, { min = 0.05, max = 0.4, step = 0.01, widget = "slider", unit = "m/s", doc = "while it searches" })
param("fast", 0.4, { min = 0.05, max = 0.4, step = 0.01, widget = "slider", unit = "m/s", doc = "once it knows the way" })

state.mouse = state.mouse or {}
local mouse = maze_mouse(1, 1, 1, state.mouse)
local at = state.mouse
local speed = config.speed

local function key(column, row) return row * 100 + column end

--- How many cells it is from each cell to the goal, through passages that are known, or also through those that may be.
local function flood(goal, only_known)
  local distances, queue = { [key(goal[1], goal[2])] = 0 }, { goal }
  for _, cell in ipairs(queue) do -- which grows meanwhile
    for direction = 0, 3 do
      local wall = mouse:wall(cell[1], cell[2], direction)
      local column, row = mouse.beside(cell[1], cell[2], direction)
      local is_open = wall == false or (wall == nil and not only_known)
      if column and is_open and not distances[key(column, row)] then
        distances[key(column, row)] = distances[key(cell[1], cell[2])] + 1
        queue[#queue + 1] = { column, row }
      end
    end
  end
  return distances
end

--- The direction that leads nearer to the goal, straight ahead where that is as good, and how far it does so.
local function downhill(distances)
  local here = distances[key(at.column, at.row)]
  for _, turn in ipairs { 0, 1, 3, 2 } do
    local direction, count = (at.direction + turn) % 4, 0
    local column, row = at.column, at.row
    while mouse:wall(column, row, direction) == false do
      column, row = mouse.beside(column, row, direction)
      if distances[key(column, row)] ~= here - count - 1 then break end
      count = count + 1
    end
    if count > 0 then return direction, count end
  end
end

--- Drives to a cell; what it learns on the way may change the way.
local function go(goal, only_known)
  while at.column ~= goal[1] or at.row ~= goal[2] do
    local direction, count = downhill(flood(goal, only_known))
    mouse:turn(direction)
    mouse:forward(only_known and count or 1)
  end
end

task("solve", function()
  local start, goal = { 1, 1 }, { config.goal[1], config.goal[2] }
  mouse:forward(0)
  local known, possible
  repeat
    go(goal, false)
    go(start, false)
    known, possible = flood(goal, true)[key(1, 1)], flood(goal, false)[key(1, 1)]
  until known == possible
  log.info(("knows the shortest way: %d cells"):format(known))
  state.known = known
  speed = config.fast
  local begun = now()
  go(goal, true)
  log.info(("is there in %.1f s"):format(now() - begun))
end)

command("map", function() return mouse.map:text() end, "the walls as they are known")

function on_execute()
  local seen = ranges:read()
  if #seen == 4 then target:write(mouse:update(pose:read(), seen, speed)) end
end
