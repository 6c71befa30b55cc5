seed(42) rate(50) physics { step = 0.01 }
arena {
  size = { 4, 3 }, border = { height = 0.3, thickness = 0.05 },
  box { at = { 1, 2, 0.5 }, size = { 0.1, 0.2, 0.3 }, yaw = 0.5, color = "#00ff7f", mass = 0.2 },
  wall { from = { 0, 0 }, to = { 0, 2 }, height = 0.4, thickness = 0.05 },
  cylinder { at = { 1, 1 }, radius = 0.1, height = 0.2, mass = 1, color = "red" },
  marker { name = "door", id = 7, size = 0.08, at = { 2, 0, 0.1 }, facing = math.pi },
  csv "map.csv", floor { image = "floor.png", size = { 1, 1 } },
}
robot("m", { model = "raspimouse", limits = { speed = 2.0 }, backend = "sim", active = false })
behavior "c" { script = "robot_controller", config = { a = 1, b = { 1, 2.5 }, c = "x" }, sets = { s = { a = 2 } }, set = "s", rate = 10 }
component "eye" { type = "Camera", on = "m", at = { 0.05, 0, 0.08 }, yaw = 0.1, rate = 30, config = { width = 640 } }
connect("m.ir_sensor_out", "c.in")
for i = 1, 3 do robot("m" .. i, { model = "raspimouse", pose = { x = i, y = 0, heading = 0 } }) end
local ok = pcall(require, "lib.swarm_arena")
rtm { nameserver = "localhost:2809", export = { "m", "c" }, interface = "127.0.0.1", rename = { ["c.in"] = "ir" } }
connect("rtm:pc.host_cxt/ConsoleOut0.out", "c.in")
