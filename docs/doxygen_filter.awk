# What Doxygen reads of a header, line by line. The comment after `#pragma once` is that of the file, and of the class
# that the file is named for where that has none; a comment before several declarations without a blank line between them
# is that of each; what every family and model has for its registry is described here.

function snake(name, text) {
  while (match(substr(name, 2), /[A-Z]/)) {
    text = text substr(name, 1, RSTART) "_"
    name = substr(name, RSTART + 1)
  }
  return tolower(text name)
}

# Makes a group of the declarations that begin in column `indent` behind the comment that begins on line `first`.
function group(first, indent, i, declarations, begins) {
  begins = "^" indent
  for (i = first; lines[i] ~ begins "///"; ++i) {}
  for (; i <= NR && lines[i] != "" && lines[i] !~ begins "//|^ ?[a-z]+:$|^}  | = (delete|default);"; ++i) {
    if (indent != "" && lines[i] ~ /^}/) break
    if (lines[i] ~ begins "(struct|class|concept|namespace) ") return
    if (lines[i] ~ begins "[^ }]" && lines[i] !~ begins "template") ++declarations
  }
  if (declarations < 2) return
  lines[first] = indent "/** @{ */ " lines[first]
  lines[i] = "/** @} */ " lines[i]
}

{ lines[NR] = $0 }

END {
  stem = FILENAME
  gsub(/.*\/|\.hpp$/, "", stem)
  if (lines[1] == "#pragma once" && lines[2] ~ /^\/\/\//) lines[1] = "/// @file"
  for (n = 3; n <= NR; ++n) {
    commented = lines[n - 1] ~ /^ *\/\/\//
    if (lines[n] ~ /^(  )?\/\/\/ / && !commented) group(n, lines[n] ~ /^  / ? "  " : "")
    if (commented) continue
    if (lines[n] ~ /^(class|struct) /) {
      split(lines[n], words, " ")
      if (words[2] ~ /^[A-Za-z]+$/ && snake(words[2]) ~ "^" stem "(_lobe|_brdf)?$") {
        at = lines[n - 1] ~ /^template/ ? n - 1 : n
        if (lines[at - 1] !~ /^\/\/\//) lines[at] = "/** @copydoc " FILENAME " */ " lines[at]
      }
    }
    if (lines[n] ~ /^class std::/) {  # a specialisation, which Doxygen cannot place
      for (i = n - 1; lines[i] != "};"; ++i) lines[i] = ""
      lines[i] = ""
    }
    if (lines[n] ~ /Info info\(\)/) lines[n] = "/** What the registry holds. */ " lines[n]
    if (lines[n] ~ /^inline .* generator\(int/) {
      lines[n] = "/** Its Generator. Precondition: dimension and parameters are admissible. */ " lines[n]
    }
  }
  for (n = 1; n <= NR; ++n) print lines[n]
}
