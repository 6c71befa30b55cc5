--- A hundred robots that wander and keep out of each other's way.
require "lib.swarm_arena" { count = 100, side = 10, model = "swarm_robot" }
