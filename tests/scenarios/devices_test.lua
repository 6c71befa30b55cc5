--- Devices on wires as components of any system, in simulation: what they send, and what reaches them.

for _, device in ipairs {
  { "I2c", { address = 0x60, measures_only = true } },
  { "Spi", { frames = { "\x01\x80\x00" }, measures_only = true } },
} do
  scenario("a component " .. device[1] .. " passes bytes in both directions", { timeout = 2 }, function(s)
    local chip = s:component "chip" { type = device[1], config = device[2] }
    s:run(0.02)
    s:inject("chip.wire_in", "\x00\x11")
    s:run(0.02)
    s:equal(chip.out.value, "\x00\x11")
    s:inject("chip.in", "\x06\xFF")
    s:run(0.02)
    s:equal(chip.wire_out.value, "\x06\xFF")
  end)
end

scenario("a component Gpio passes texts, and only those that its lines know", { timeout = 2 }, function(s)
  local pins = s:component "pins" { type = "Gpio", config = { outputs = { 23 }, inputs = { 24 }, safe = "23=0" } }
  s:run(0.02)
  s:inject("pins.wire_in", "24=1 0.015000")
  s:run(0.02)
  s:equal(pins.out.value, "24=1 0.015000")
  s:inject("pins.in", "23=1")
  s:run(0.02)
  s:equal(pins.wire_out.value, "23=1")
  s:inject("pins.in", "24=1")
  s:run(0.02)
  s:equal(pins.wire_out.value, "23=1")
  s:stop()
  s:run(0.02)
  s:equal(pins.wire_out.value, "23=0")
end)
