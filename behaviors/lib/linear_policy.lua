--- What a learned mouse sees and does: the same in the environment, where it learns, and in the behaviour, which plays it.

local policy = {}

--- The numbers that the weights are multiplied with: nearness of each sensor, 0 (0.3 m or more) to 1 (touching), then 1.
policy.SENSORS = 4
local FAR = 0.3 -- [m]

---@param ranges number[] distances [m]
function policy.features(ranges)
  local features = {}
  for i = 1, policy.SENSORS do
    features[i] = 1 - math.min(ranges[i] or FAR, FAR) / FAR
  end
  features[#features + 1] = 1
  return features
end

--- The velocity of two numbers from -1 to 1: backwards to forwards, right to left.
function policy.velocity(forward, turn)
  return { vx = 0.3 * forward, va = 3 * turn }
end

local function limited(number) return math.max(-1, math.min(1, number)) end

--- What these weights do: two rows, one after the other, of the length of the features.
---@param weights number[]
---@param features number[]
function policy.act(weights, features)
  local sums = { 0, 0 }
  for row = 1, 2 do
    for i, feature in ipairs(features) do
      sums[row] = sums[row] + (weights[(row - 1) * #features + i] or 0) * feature
    end
  end
  return limited(sums[1]), limited(sums[2])
end

return policy
