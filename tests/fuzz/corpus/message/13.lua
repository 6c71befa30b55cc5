return { position = { x = 1, y = 2, z = 3 }, orientation = { r = 1, p = 2, y = 3 } }
