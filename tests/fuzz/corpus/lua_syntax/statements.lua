do goto on local x ::on:: end
for i = 1, 3 do if i == 2 then goto continue end ::continue:: end
while true do break end
repeat local x <const> = 1 until x
local function f(a, ...) return a, ... end
