--- Drives a mouse in a maze for a solver that was written for the simulator mms: `nezumi mms` gives it one movement after
--- the other, and asks it what its sensors have seen of the walls.

local maze_mouse = require "maze_mouse"

local pose   = input("pose", "TimedPose2D", "where the wheels say that the mouse is")
local ranges = input("ranges", "TimedDoubleSeq", "distances [m]: right front, right side, left side, left front")
local target = output("target", "TimedVelocity2D", "target velocity")

param("size", { 16, 16 }, { min_size = 2, max_size = 2, min = 1, max = 64, doc = "columns and rows of the maze" })
param("speed", 0.3, { min = 0.05, max = 0.4, step = 0.01, widget = "slider", unit = "m/s", doc = "at most" })

state.mouse = state.mouse or {}
if state.busy == nil then state.busy = true end -- until the mouse stands in the middle of its cell
local mouse = maze_mouse(1, 1, 1, state.mouse, config.size)

task("move", function()
  mouse:forward(0) -- after a reload, the movement that was under way
  while true do
    state.busy = state.halves ~= nil or state.eighths ~= nil
    wait_until(function() return state.halves or state.eighths end)
    local halves, eighths = state.halves, state.eighths
    state.halves, state.eighths = nil, nil
    if eighths then
      mouse:turn((state.mouse.direction + eighths / 2) % 4)
    else
      mouse:drive(halves)
    end
  end
end)

command("drive", function(halves)
  state.halves, state.busy = halves, true
end, "drives so many half cells ahead")

command("turn", function(eighths)
  state.eighths, state.busy = eighths, true
end, "turns by so many eighths, counter-clockwise")

command("home", function()
  cancel("move")
  mouse:place(1, 1, 1)
  state.halves, state.eighths, state.busy, state.was_reset = nil, nil, true, false
  start("move")
end, "it was set down at the start")

command("press_reset", function() state.was_reset = true end, "the reset button: the solver gives up this run")

command("walls", function(column, row)
  local seen = {}
  for direction = 0, 3 do seen[direction + 1] = mouse:wall(column, row, direction) == true end
  return seen
end, "whether the mouse has seen walls of a cell in the east, north, west and south")

function on_execute()
  local seen = ranges:read()
  if #seen == 4 then target:write(mouse:update(pose:read(), seen, config.speed)) end
end
