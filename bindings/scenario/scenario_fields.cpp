// The options of a scenario's words, for editors and documentation.
#include "bindings/scenario/scenario_fields.hpp"

namespace nezumi {

const std::vector<RecordShape>& scenario_records() {
    static const std::vector<RecordShape> records{
        shape_of_record<Scenario>(),    shape_of_record<Expectation::Terms>(), shape_of_record<GoldenOptions>(),
        shape_of_record<LoadOptions>(), shape_of_record<ReloadOptions>(),      shape_of_record<RecordedOptions>(),
        shape_of_record<JudgeRequest>()};
    return records;
}

}  // namespace nezumi
