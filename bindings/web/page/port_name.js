// Names of ports: "controller.in", "ev3/vehicle.current_vel", "rtm:pc.host_cxt/ConsoleIn0.out".

/// [component, port]: "rtm:pc.host_cxt/ConsoleIn0", "out".
export function split_port(full) {
  const dot = full.lastIndexOf(".");
  return [full.slice(0, dot), full.slice(dot + 1)];
}

export const owner_of = (port) => split_port(port)[0];
