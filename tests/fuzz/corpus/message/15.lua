return { width = 2, height = 1, bpp = 8, format = "gray8", fDiv = 1, pixels = "ab" }
