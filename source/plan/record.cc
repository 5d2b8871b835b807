#include <morsel/core/data_files.h>
#include <morsel/core/errors.h>
#include <morsel/plan/record.h>

#include <fstream>

namespace Morsel::Plan
{
  using nlohmann::ordered_json;

  namespace
  {
    Method::Texts
    texts_of(const ordered_json &object)
    {
      Method::Texts texts;
      for (const auto &[name, text] : object.items())
        texts.emplace_back(name, text.get<std::string>());
      return texts;
    }


    Method
    method_of(const ordered_json &object)
    {
      Method method;
      object.at("name").get_to(method.name);
      object.at("title").get_to(method.title);
      object.at("size_label").get_to(method.size_label);
      method.entries  = texts_of(object.at("entries"));
      method.formulas = texts_of(object.at("formulas"));
      for (const ordered_json &run : object.at("runs"))
        method.runs.push_back(
            {run.at("size").get<double>(), run.at("error").get<double>()});
      return method;
    }
  } // namespace


  Record
  read_record(const ordered_json &document, const std::string &file)
  {
    try
      {
        Record record;
        record.file = file;
        document.at("kind").get_to(record.kind);
        document.at("title").get_to(record.title);
        document.at("study").get_to(record.study);
        document.at("error").get_to(record.error);
        document.at("truth").get_to(record.truth);
        record.remark = document.value("remark", "");
        for (const ordered_json &method : document.at("methods"))
          record.methods.push_back(method_of(method));
        return record;
      }
    catch (const nlohmann::json::exception &error)
      {
        throw FileError("The record '" + file +
                        "' is not understood: " + error.what());
      }
  }


  std::vector<Record>
  shipped_records(const std::string &kind)
  {
    std::vector<Record> records;
    for (const std::string &file : shipped_json_files("recorded"))
      {
        std::ifstream      stream(file);
        const ordered_json document =
            ordered_json::parse(stream, nullptr, false);
        // Costs have no kind.
        if (document.is_object() && document.contains("kind") &&
            document["kind"] == kind)
          records.push_back(read_record(document, file));
        else if (document.is_discarded())
          throw FileError("The record '" + file + "' is no JSON.");
      }
    return records;
  }
} // namespace Morsel::Plan
