--- Learns a maze by flood fill, then takes the shortest way and cuts the corners: it crosses stairs of cells on diagonals.

local maze_mouse = require "maze_mouse"
local maze_search = require "maze_search"

local pose   = input("pose", "TimedPose2D", "where the wheels say that the mouse is")
local ranges = input("ranges", "TimedDoubleSeq", "distances [m]: right front, right side, left side, left front")
local target = output("target", "TimedVelocity2D", "target velocity")

param("goal", { 8, 8 }, { min_size = 2, max_size = 128, min = 1, max = 64, doc = "column and row of the cell to find, or of several" })
param("home", { 1, 1 }, { min_size = 2, max_size = 2, min = 1, max = 64, doc = "column and row of the cell where it begins" })
param("direction", 1, { min = 0, max = 3, doc = "quarter turns from east, to which it looks there" })
param("size", { 16, 16 }, { min_size = 2, max_size = 2, min = 1, max = 64, doc = "columns and rows of the maze, at most" })
param("speed", 0.3, { min = 0.05, max = 0.4, step = 0.01, widget = "slider", unit = "m/s", doc = "while it searches" })
param("fast", 0.4, { min = 0.05, max = 0.4, step = 0.01, widget = "slider", unit = "m/s", doc = "once it knows the way" })

state.mouse = state.mouse or {}
local mouse = maze_mouse(config.home[1], config.home[2], config.direction, state.mouse, config.size)
local speed = config.speed

--- 1 for a turn to the left after this cell of the way, -1 to the right, 0 straight on.
local function turn_after(way, i)
  if not way[i] or not way[i + 1] then return 0 end
  return (way[i + 1] - way[i] + 1) % 4 - 1
end

--- A turn belongs to stairs if the one before or after it leads to the other side.
local function is_stair(way, i)
  local turn = turn_after(way, i)
  return turn ~= 0 and (turn_after(way, i - 1) == -turn or turn_after(way, i + 1) == -turn)
end

--- The way in half cells: { direction, halves }, with half directions on diagonals.
local function legs_of(way)
  local legs = {}
  local function add(direction, halves)
    local last = legs[#legs]
    if last and last[1] == direction then last[2] = last[2] + halves else legs[#legs + 1] = { direction, halves } end
  end
  add(way[1], 1)
  for i, direction in ipairs(way) do
    if i == #way then
      add(direction, 1)
    elseif is_stair(way, i) then
      add((direction + turn_after(way, i) / 2) % 4, 1)
    else
      add(direction, 1)
      add(way[i + 1], 1)
    end
  end
  return legs
end

task("solve", function()
  local search = maze_search(mouse, config.home, config.goal)
  mouse:forward(0)
  local known = search:explore()
  log.info(("knows the shortest way: %d cells"):format(known))
  state.known = known
  speed = config.fast
  local begun = now()
  for _, leg in ipairs(legs_of(search:way())) do
    mouse:turn(leg[1])
    mouse:drive(leg[2])
  end
  state.time = now() - begun
  log.info(("is there in %.1f s"):format(state.time))
end)

command("map", function() return mouse.map:text() end, "the walls as they are known")

function on_execute()
  local seen = ranges:read()
  if #seen == 4 then target:write(mouse:update(pose:read(), seen, speed)) end
end
