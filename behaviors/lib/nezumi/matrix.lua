--- Dense matrices of finite numbers, at most 64 x 64, computed by Eigen: `matrix { { 4, 1 }, { 2, 3 } }`.
--- In `state` a matrix is the table of its rows: `state.p = matrix(state.p or { { 1, 0 }, { 0, 1 } })`.

---@class nezumi.Matrix
---@field rows integer
---@field columns integer
---@field [integer] number[] row i: `m[i][j]` is read and assigned
---@operator add(nezumi.Matrix): nezumi.Matrix
---@operator sub(nezumi.Matrix): nezumi.Matrix
---@operator mul(nezumi.Matrix|number): nezumi.Matrix
---@operator unm: nezumi.Matrix
---@field transpose fun(self: nezumi.Matrix): nezumi.Matrix
---@field solve fun(self: nezumi.Matrix, b: nezumi.Matrix): nezumi.Matrix x with self * x = b
---@field inverse fun(self: nezumi.Matrix): nezumi.Matrix
---@field cholesky fun(self: nezumi.Matrix): nezumi.Matrix the lower l with l * l:transpose() = self
---@field to_table fun(self: nezumi.Matrix): number[][]

---@class nezumi.MatrixModule
---@field identity fun(rows: integer): nezumi.Matrix
---@field zeros fun(rows: integer, columns: integer): nezumi.Matrix
---@overload fun(rows: number[][]|nezumi.Matrix): nezumi.Matrix

---@type nezumi.MatrixModule
local matrix = require "native.matrix"

return matrix
