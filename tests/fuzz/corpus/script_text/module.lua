local M = {}
local angles = require "nezumi.angles"
function M.half(a) return angles.wrap(a / 2) end
return M
