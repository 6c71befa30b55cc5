return { vx = 0/0 }
