--- Finds the way through a maze with the left hand on the wall: turns left wherever it can.

local maze_mouse = require "maze_mouse"

local pose   = input("pose", "TimedPose2D", "where the wheels say that the mouse is")
local ranges = input("ranges", "TimedDoubleSeq", "distances [m]: right front, right side, left side, left front")
local target = output("target", "TimedVelocity2D", "target velocity")

param("goal", { 8, 8 }, { min_size = 2, max_size = 2, min = 1, max = 16, doc = "column and row of the cell to find" })
param("speed", 0.3, { min = 0.05, max = 0.4, step = 0.01, widget = "slider", unit = "m/s", doc = "at most" })

state.mouse, state.cells = state.mouse or {}, state.cells or 0
local mouse = maze_mouse(1, 1, 1, state.mouse)
local at = state.mouse

task("solve", function()
  mouse:forward(0)
  while at.column ~= config.goal[1] or at.row ~= config.goal[2] do
    for _, turn in ipairs { 1, 0, 3, 2 } do -- left, ahead, right, back
      local direction = (at.direction + turn) % 4
      if not mouse:wall(at.column, at.row, direction) then
        mouse:turn(direction)
        break
      end
    end
    mouse:forward(1)
    state.cells = state.cells + 1
  end
  log.info(("is there after %d cells"):format(state.cells))
end)

command("map", function() return mouse.map:text() end, "the walls as they are known")

function on_execute()
  local seen = ranges:read()
  if #seen == 4 then target:write(mouse:update(pose:read(), seen, config.speed)) end
end
