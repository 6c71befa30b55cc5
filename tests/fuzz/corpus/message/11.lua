return { vx = 0.1, va = 2 }
