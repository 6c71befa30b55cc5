--- The module nezumi.matrix: what it computes, and what it refuses.

local matrix = require "nezumi.matrix"

--- What a call says when it fails, with its line, which is to be one of this file.
local function said(f)
  local ok, message = pcall(f)
  local file, text = tostring(message):match("^(.-):%d+: (.*)$")
  return not ok and file and file:match("matrix_module_test%.lua$") and text or "not refused here: " .. tostring(message)
end

local function equal(s, actual, expected) s:check(actual == expected, ("%s, not %s"):format(actual, expected)) end

local function near(s, m, rows, tolerance)
  s:check(m.rows == #rows and m.columns == #rows[1], tostring(m))
  for i, row in ipairs(rows) do
    for j, value in ipairs(row) do s:near(m[i][j], value, tolerance or 1e-12) end
  end
end

--- A matrix of numbers between -1 and 1 that are always the same.
local function drawn(rows, columns)
  local m = matrix.zeros(rows, columns)
  for i = 1, rows do
    for j = 1, columns do m[i][j] = 2 * math.random() - 1 end
  end
  return m
end

scenario("a matrix is made of its rows and read by row and column", function(s)
  local m = matrix { { 4, 1, 7 }, { 2, 3, -0.5 } }
  s:check(m.rows == 2 and m.columns == 3)
  near(s, m, { { 4, 1, 7 }, { 2, 3, -0.5 } })
  m[2][3] = 9
  near(s, m, { { 4, 1, 7 }, { 2, 3, 9 } })
  near(s, matrix.identity(2), { { 1, 0 }, { 0, 1 } })
  near(s, matrix.zeros(1, 3), { { 0, 0, 0 } })
end)

scenario("a copy is one of its own", function(s)
  local m = matrix { { 1, 2 } }
  local copy = matrix(m)
  copy[1][1] = 5
  near(s, m, { { 1, 2 } })
  local row = m[1]
  m = nil
  row[2] = 7
  s:near(row[1] + row[2], 8, 0, "a row keeps its matrix")
end)

scenario("matrices are added, subtracted, multiplied, compared", function(s)
  local a, b = matrix { { 1, 2 }, { 3, 4 } }, matrix { { 0, 1 }, { -1, 2 } }
  near(s, a + b, { { 1, 3 }, { 2, 6 } })
  near(s, a - b, { { 1, 1 }, { 4, 2 } })
  near(s, a * b, { { -2, 5 }, { -4, 11 } })
  near(s, 2 * a, { { 2, 4 }, { 6, 8 } })
  near(s, a * 0.5, { { 0.5, 1 }, { 1.5, 2 } })
  near(s, -a, { { -1, -2 }, { -3, -4 } })
  near(s, a * matrix { { 1 }, { 10 } }, { { 21 }, { 43 } })
  near(s, matrix { { 1, 2, 3 } }:transpose(), { { 1 }, { 2 }, { 3 } })
  s:check(a == matrix(a) and a ~= b and a ~= matrix { { 1, 2 } })
end)

scenario("solving, inverting and Cholesky's factor come back to what they began with",
  { sweep = { size = { 1, 2, 3, 7, 40, 64 } } }, function(s, p)
    local a, b = drawn(p.size, p.size) + matrix.identity(p.size) * p.size, drawn(p.size, 2)
    local x = a:solve(b)
    near(s, a * x, b:to_table(), 1e-9)
    near(s, a * a:inverse(), matrix.identity(p.size):to_table(), 1e-9)
    local square = a * a:transpose()
    local lower = square:cholesky()
    near(s, lower * lower:transpose(), square:to_table(), 1e-6)
    for i = 1, p.size do
      for j = i + 1, p.size do s:near(lower[i][j], 0, 0) end
    end
  end)

scenario("a matrix is shown as its rows, and is a table when it is asked to be", function(s)
  local m = matrix { { 4, 1 }, { 2.5, 3 } }
  equal(s, tostring(m), "{ { 4.0, 1.0 }, { 2.5, 3.0 } }")
  equal(s, tostring(m[2]), "{ 2.5, 3.0 }")
  local rows = m:to_table()
  s:check(#rows == 2 and #rows[1] == 2 and rows[2][1] == 2.5)
  near(s, matrix(rows), { { 4, 1 }, { 2.5, 3 } })
end)

scenario("the inverse of a singular matrix is an error", function(s)
  local singular = matrix { { 1, 2 }, { 2, 4 } }
  equal(s, said(function() singular:inverse() end), "inverse: the matrix is singular")
  equal(s, said(function() singular:solve(matrix { { 1 }, { 1 } }) end), "solve: the matrix is singular")
  equal(s, said(function() matrix.zeros(3, 3):inverse() end), "inverse: the matrix is singular")
  equal(s, said(function() matrix { { 1, 2 }, { 3, 4 } }:cholesky() end), "cholesky: the matrix is not symmetric")
  equal(s, said(function() matrix { { 1, 2 }, { 2, 1 } }:cholesky() end), "cholesky: the matrix is not positive definite")
  equal(s, said(function() matrix { { 1, 2 } }:inverse() end), "inverse expected a square matrix, got 1 x 2")
  equal(s, said(function() matrix { { 1, 2 } }:solve(singular) end), "solve expected a square matrix, got 1 x 2")
  equal(s, said(function() singular:solve(matrix { { 1 } }) end), "solve expected a matrix of 2 rows, got 1 x 1")
  equal(s, said(function() singular:solve { 1, 2 } end), "solve expected a matrix, got table")
end)

scenario("sizes that do not fit are an error", function(s)
  local a, b = matrix.zeros(2, 3), matrix.zeros(2, 2)
  equal(s, said(function() return a + b end), "2 x 3 + 2 x 2: both must have the same size")
  equal(s, said(function() return a - b end), "2 x 3 - 2 x 2: both must have the same size")
  equal(s, said(function() return a * b end),
    "2 x 3 * 2 x 2: the columns of the left one and the rows of the right one must be equal in number")
  equal(s, said(function() return a + 1 end), "matrix + expected two matrices, one is a number")
  equal(s, said(function() return {} * a end), "matrix * expected a matrix or a number, got table")
  equal(s, said(function() return a * a[1] end), "matrix * expected a matrix or a number, got row of a matrix")
end)

scenario("a value that is not a matrix is refused", function(s)
  equal(s, said(function() matrix() end), "matrix expected a table of rows, got nil")
  equal(s, said(function() matrix {} end), "matrix: expected 1 to 64 rows, got 0")
  equal(s, said(function() matrix { {} } end), "matrix: expected 1 to 64 columns, got 0")
  equal(s, said(function() matrix { 1, 2 } end), "matrix: row 1 expected a table of numbers, got number")
  equal(s, said(function() matrix { { 1, 2 }, { 3 } } end),
    "matrix: all rows must have the same length: row 1 has 2 columns, row 2 has 1")
  equal(s, said(function() matrix { { 1, "2" } } end), "matrix: row 1, column 2 expected a finite number, got string")
  equal(s, said(function() matrix { { 1, math.huge } } end), "matrix: row 1, column 2 expected a finite number, got inf")
  local wide = {}
  for i = 1, 65 do wide[i] = i end
  equal(s, said(function() matrix { wide } end), "matrix: expected 1 to 64 columns, got 65")
  equal(s, said(function() matrix.zeros(65, 1) end), "matrix.zeros expected a number of rows from 1 to 64")
  equal(s, said(function() matrix.identity(2.5) end), "matrix.identity expected a number of rows from 1 to 64")
end)

scenario("a row or column outside of a matrix is refused", function(s)
  local m = matrix { { 1, 2 }, { 3, 4 } }
  equal(s, said(function() return m[3] end), "there is no row 3 in a matrix of 2 x 2")
  equal(s, said(function() return m[1][0] end), "there is no column 0 in a matrix of 2 x 2")
  equal(s, said(function() m[1][1.5] = 2 end), "there is no column 1.5 in a matrix of 2 x 2")
  equal(s, said(function() m[2][1] = 0 / 0 end), "matrix: row 2, column 1 expected a finite number, got nan")
  equal(s, said(function() m[2][1] = nil end), "matrix: row 2, column 1 expected a finite number, got nil")
  equal(s, said(function() m[1] = { 1, 2 } end), "only single elements of a matrix can be set: m[i][j] = value")
  equal(s, said(function() return m.row end), "a matrix has no 'row' (did you mean 'rows'?)")
  equal(s, said(function() m.inverse() end), "inverse expected a matrix before the colon: m:inverse(...)")
  s:check(getmetatable(m) == false and getmetatable(m[1]) == false)
  s:check(not pcall(setmetatable, m, {}) and not pcall(function() matrix.new = 1 end))
end)

scenario("a result that is not finite is refused", function(s)
  local large = matrix { { 1e308 } }
  equal(s, said(function() return large + large end), "+: the result is not finite")
  equal(s, said(function() return large * 10 end), "*: the result is not finite")
  equal(s, said(function() return large * large end), "*: the result is not finite")
  equal(s, said(function() return large * math.huge end), "*: the result is not finite")
end)
