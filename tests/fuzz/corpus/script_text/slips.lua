local taget = output("out", "TimedVelocty2D")
output("out", "TimedLong")
param("end", nil, { min = 2, max = 1, stp = 3 })
function on_exeute() target:write(config.x) os.exit() end
