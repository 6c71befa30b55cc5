--- Fills a square arena with a swarm: `require "lib.swarm_arena" { count = 100, side = 10, model = "swarm_robot" }`.
--- With `radius`, each robot has a sensor of kind `neighbours` that sees so far [m].
--- The same numbers give the same places.

local RADIUS = 0.085 -- m, of a robot
local WALL   = 0.1   -- m

--- Places for `count` robots that keep `apart` metres from each other and from the walls.
local function places(count, side, apart)
  local reach = side / 2 - apart
  local taken, cell, rows = {}, apart, side // apart + 3
  local function is_free(x, y)
    local column, row = x // cell, y // cell
    for c = column - 1, column + 1 do
      for r = row - 1, row + 1 do
        for _, other in ipairs(taken[c * rows + r] or {}) do
          if (other.x - x) ^ 2 + (other.y - y) ^ 2 < apart * apart then return false end
        end
      end
    end
    return true
  end
  local found = {}
  for tries = 1, 1000 * count do
    if #found == count then break end
    local x, y = (2 * math.random() - 1) * reach, (2 * math.random() - 1) * reach
    if is_free(x, y) then
      local place = { x = x, y = y, heading = (2 * math.random() - 1) * math.pi }
      local key = x // cell * rows + y // cell
      taken[key] = taken[key] or {}
      table.insert(taken[key], place)
      table.insert(found, place)
    end
  end
  assert(#found == count, ("an arena of %g m is too small for %d robots"):format(side, count))
  return found
end

return function(options)
  math.randomseed(options.seed or 124)
  seed(options.seed or 124)
  rate(10)
  physics { step = 0.01 }

  local half = options.side / 2 + WALL / 2
  local long = half + WALL / 2
  arena {
    wall { from = { -long, -half }, to = { long, -half }, thickness = WALL, height = 0.5 },
    wall { from = { -long, half }, to = { long, half }, thickness = WALL, height = 0.5 },
    wall { from = { -half, -long }, to = { -half, long }, thickness = WALL, height = 0.5 },
    wall { from = { half, -long }, to = { half, long }, thickness = WALL, height = 0.5 },
  }
  for i, pose in ipairs(places(options.count, options.side, 2.2 * RADIUS)) do
    local more = options.radius and { near = { kind = "neighbours", radius = options.radius } } or nil
    local ports = more and { near = { type = "NeighbourSeq", from = "near" } }
    robot("robot_" .. i, { model = options.model, pose = pose, sensors = more, ports = ports })
    behavior("swarm_" .. i, { script = "swarm" })
    connect("robot_" .. i .. ".rays", "swarm_" .. i .. ".rays")
    connect("swarm_" .. i .. ".out", "robot_" .. i .. ".velocity")
  end
end
