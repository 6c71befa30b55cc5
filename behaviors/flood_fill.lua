--- Learns a maze, then takes the shortest way through it: flood fill, as the mice of the contests do.

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

task("solve", function()
  local search = maze_search(mouse, config.home, config.goal)
  mouse:forward(0)
  local known = search:explore()
  log.info(("knows the shortest way: %d cells"):format(known))
  state.known = known
  speed = config.fast
  local begun, way = now(), search:way()
  local count = 0
  for i, direction in ipairs(way) do
    count = count + 1
    if way[i + 1] ~= direction then
      mouse:turn(direction)
      mouse:forward(count)
      count = 0
    end
  end
  state.time = now() - begun
  log.info(("is there in %.1f s"):format(state.time))
end)

command("map", function() return mouse.map:text() end, "the walls as they are known")

function on_execute()
  local seen = ranges:read()
  if #seen == 4 then target:write(mouse:update(pose:read(), seen, speed)) end
end
