#include "mutate_values.h"

#include <cctype>
#include <cstdlib>
#include <sstream>
#include <utility>
#include <vector>

namespace Fuzz
{
  namespace
  {
    const std::vector<std::string> strange_values = {
        "",
        "nan",
        "-nan",
        "inf",
        "-inf",
        "0",
        "-0",
        "-1",
        "1",
        "2",
        "0.5",
        "1e-3",
        "1e308",
        "-1e308",
        "1e300",
        "1e155",
        "1e100",
        "1e30",
        "1e-30",
        "1e-308",
        "4.9e-324",
        "1e400",
        "1e12",
        "1e9",
        "1000000",
        "100000",
        "10000",
        "1000",
        "65536",
        "2147483647",
        "2147483648",
        "-2147483649",
        "4294967295",
        "4294967296",
        "9223372036854775808",
        "99999999999999999999",
        "0x10",
        "1e",
        "1e+",
        "--1",
        "+-1",
        "1.2.3",
        "1,5",
        "1;5",
        "1 2",
        "1e5 Pa",
        "10 mm",
        "10kPa",
        "5%",
        "25 °C",
        "true",
        "false",
        "maybe",
        "none",
        "auto",
        "all",
        ",",
        ",,,",
        "0, 0",
        "0, 0, 0",
        "1e308, 1e308",
        "nan, nan",
        "0, 0 > 0, 0",
        "0, 0 > 1, 1 > 0, 0",
        "a: b",
        "a:b, c:d",
        "1: 2, 1: 3",
        ":",
        ";",
        "=",
        "= 3",
        "*",
        "\\",
        "\"",
        "'",
        "/",
        ".",
        "..",
        "../..",
        "../../escaped",
        "/dev/null",
        "/dev/zero",
        "/dev/stdin",
        "/proc/self/mem",
        "/proc/self/maps",
        "/etc/passwd",
        "no/such/file.msh",
        "../../meshes/cusp.msh",
        "../../meshes/cusp.geo",
        "../../meshes/mandible.msh",
        "../jaw/minimum_jerk.csv",
        "../food/peanut.prm",
        "%s%s%s%n",
        "$(touch escaped)",
        "`touch escaped`",
        "{}",
        "[1, 2]",
        "<b>bold</b>",
        "1/0",
        "0/0",
        "sqrt(-1)",
        "log(0)",
        "2*pi",
        "x",
        "y",
        "t",
        "sin(x)*1e300",
        "exp(1000*x)",
        "x^x^x^x",
        "if(x>0, 1)",
        "rand()",
        "x; y",
        "x; y; x",
        "0; 0",
        "sqrt(particle_count)",
        "((((((((1))))))))",
        "(((",
        ")))",
        "\xC3\xA9t\xC3\xA9",
        "\xE9",
        "\xF0\x9F\xA5\x9C"};


    /// Values too long to write down.
    std::string
    long_value(Random &random)
    {
      std::string result;
      switch (random.below(6))
        {
          case 0:
            return std::string(100000, 'a');
          case 1:
            return std::string(10000, '9');
          case 2:
            return "0." + std::string(10000, '3');
          case 3:
            for (unsigned int i = 0; i < 20000; ++i)
              result += (i > 0 ? ", " : "") + std::to_string(i);
            return result;
          case 4:
            return std::string(20000, '(') + "x" + std::string(20000, ')');
          default:
            for (unsigned int i = 0; i < 3000; ++i)
              result += (i > 0 ? " > " : "") + std::to_string(i) + ", 0";
            return result;
        }
    }


    /// Where the numbers of a text begin and how long they are.
    std::vector<std::pair<std::size_t, std::size_t>>
    numbers_in(const std::string &text)
    {
      std::vector<std::pair<std::size_t, std::size_t>> result;
      for (std::size_t i = 0; i < text.size();)
        {
          char      *end = nullptr;
          const bool word =
              i > 0 &&
              (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0 ||
               text[i - 1] == '_');
          if (!word && text.find_first_of("0123456789.-+", i) == i &&
              (std::strtod(text.c_str() + i, &end), end > text.c_str() + i))
            {
              const std::size_t length = end - (text.c_str() + i);
              result.emplace_back(i, length);
              i += length;
            }
          else
            ++i;
        }
      return result;
    }


    std::string
    changed_number(const std::string &number, Random &random)
    {
      static const std::vector<double> factors = {
          -1.,  0.,    0.5,  0.9,  1.1, 2.,  3.,   10.,   0.1,   100.,
          0.01, 1000., 1e-3, 1e-6, 1e6, 1e9, 1e-9, 1e-12, 1e100, 1e-100};
      if (random.chance(25))
        return strange_value(random);
      const double       value = std::strtod(number.c_str(), nullptr);
      std::ostringstream text;
      if (random.chance(20))
        text << value + (random.chance(50) ? 1. : -1.);
      else
        text << value * random.pick(factors);
      return text.str();
    }


    std::vector<std::string>
    split(const std::string &text, const char separator)
    {
      std::vector<std::string> parts;
      std::istringstream       stream(text);
      for (std::string part; std::getline(stream, part, separator);)
        parts.push_back(part);
      return parts;
    }


    /// A list with a part left out, doubled, replaced, moved or many times.
    std::string
    changed_list(const std::string &value, const char separator, Random &random)
    {
      std::vector<std::string> parts = split(value, separator);
      const std::size_t        k     = random.below(parts.size());
      switch (random.below(5))
        {
          case 0:
            parts.erase(parts.begin() + k);
            break;
          case 1:
            parts.insert(parts.begin() + k, parts[k]);
            break;
          case 2:
            parts[k] = strange_value(random);
            break;
          case 3:
            std::swap(parts[k], parts[random.below(parts.size())]);
            break;
          default:
            parts.insert(parts.begin() + k, 100, parts[k]);
        }
      std::string result;
      for (std::size_t i = 0; i < parts.size(); ++i)
        result += (i > 0 ? std::string(1, separator) : "") + parts[i];
      return result;
    }
  } // namespace


  const std::string &
  strange_value(Random &random)
  {
    return random.pick(strange_values);
  }


  std::string
  mutate_value(const std::string &value, Random &random)
  {
    const auto         numbers   = numbers_in(value);
    const std::size_t  separated = value.find_first_of(",;>:");
    const unsigned int choice    = random.below(100);
    if (choice < 4)
      return long_value(random);
    if (choice < 55 && !numbers.empty())
      {
        const auto [begin, length] = random.pick(numbers);
        return value.substr(0, begin) +
               changed_number(value.substr(begin, length), random) +
               value.substr(begin + length);
      }
    if (choice < 70 && separated != std::string::npos)
      return changed_list(value, value[separated], random);
    return strange_value(random);
  }
} // namespace Fuzz
