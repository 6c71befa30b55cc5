return { position = { x = 1, y = 2 }, heading = 3 }
