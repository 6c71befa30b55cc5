// Finds the Pi's voltage monitor by its name, because the number in its path is not fixed.
#include "hw/raspimouse/supply.hpp"

#include "hw/raspimouse/advice.hpp"

namespace nezumi::hw {

void Supply::find() {
    const auto monitors = folder_.files().list(folder_.text());
    if (!monitors) return;
    for (const std::string& monitor : *monitors) {
        Node name(folder_ + "/" + monitor + "/name", Node::Access::read);
        const auto text = name.read();
        if (text && text->starts_with("rpi_volt"))
            alarm_.emplace(folder_ + "/" + monitor + "/in0_lcrit_alarm", Node::Access::read);
    }
}

tl::expected<std::optional<bool>, std::string> Supply::sample(double /*now*/) {
    if (!alarm_) find();
    if (!alarm_) return std::nullopt;
    const auto text = alarm_->read();
    is_low_ = text && text->starts_with('1');
    if (!text) {
        const std::string why = with_mouse_advice(text.error());
        alarm_.reset();
        return tl::unexpected(why);
    }
    if (is_low_)
        return tl::unexpected(
            std::string("is low, the Raspberry Pi gets less than 4.63 V: the robot stands until its battery has been "
                        "charged or changed"));
    return false;
}

}  // namespace nezumi::hw
