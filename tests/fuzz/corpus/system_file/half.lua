robot "m"
box { at = { 0, 0 }, size = { 1, 1, 1 } }