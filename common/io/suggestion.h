// What a word that is no key may have been meant for: the nearest spelling, or the key that drawings, standards and other
// programs call by that word.
//
// Private to the layer io/.
#pragma once
#include <string>
#include <vector>

namespace whine {

struct Key;

// The known word nearest to `word` by edit distance, "" if none is near.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

// What stands behind "unknown key 'width_mm' in [gear.pinion]": "; did you mean 'face_width_mm'?", the section that a key
// belongs into, or why there is none for what the word means. "" if nothing is near. `section` is that of the key table,
// `known` what is allowed in it.
std::string advice_on_key(const std::string& word, const std::string& section,
                          const std::vector<std::string>& known);

// The key of a scene that the word means: by its meaning, else by its spelling; nullptr if there is none. `note`: a remark on
// how its value differs, or why there is no such key.
const Key* meant_key(const std::string& word, std::string& note);

// The present name of a key or choice that earlier versions called `word`; "" if it was not renamed.
std::string renamed(const std::string& word);

// Behind "must be a number" of a text in quotes, "; write 2.5 without quotes": "" if it holds no number.
std::string number_advice(const std::string& word);

// Of a line that is no TOML: "; numbers have a decimal point: 2.5, not 2,5", "; text stands in quotes: \"steel\"", "" of others.
std::string value_advice(const std::string& line);

}  // namespace whine
