return setmetatable({}, { __index = function() return 1 end, __len = function() return 1e9 end })
