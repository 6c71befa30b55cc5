return { 1.5, 2 }
