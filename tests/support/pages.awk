# Prints a Markdown page as it should be; see check_pages.sh. Set: root, the repository; work, a folder for the commands.
# What cannot be put right is named on stderr, and the exit status is 1.

function complain(what) {
  print FILENAME ":" opened ": " what > "/dev/stderr"
  bad = 1
}

# The lines of a file, each ended by a newline, or "" for a file that is not there.
function lines_of(path, line, text) {
  text = ""
  while ((getline line < path) > 0) text = text line "\n"
  close(path)
  return text
}

function without_indent(text) {
  gsub(/\n +/, "\n", text)
  sub(/^ +/, "", text)
  return text
}

# Half a unit more than one of the last place of a number as it is written.
function last_place(number, parts, decimals) {
  if (number !~ /[.e]/) return 0
  split(number, parts, "e")
  decimals = parts[1]
  if (!sub(/.*\./, "", decimals)) decimals = ""
  return 1.5 * 10 ^ (parts[2] - length(decimals))
}

function magnitude(x) { return x < 0 ? -x : x }

function near(a, b, share, allowed) {
  if (a == b) return 1
  allowed = (share > 0 ? share : 1e-7) * (magnitude(a) > magnitude(b) ? magnitude(a) : magnitude(b))
  if (a !~ /[.e]/ && b !~ /[.e]/ && !share) return 0
  if (last_place(a) > allowed) allowed = last_place(a)
  return magnitude(a - b) <= allowed
}

# Whether two texts have the same words, and numbers that are near each other.
function alike(a, b, share, number_a, at_a, number_b, at_b) {
  gsub(/  +/, " ", a)
  gsub(/  +/, " ", b)
  while (match(a, kNumber)) {
    at_a = RSTART
    number_a = substr(a, RSTART, RLENGTH)
    if (!match(b, kNumber)) return 0
    at_b = RSTART
    number_b = substr(b, RSTART, RLENGTH)
    if (substr(a, 1, at_a - 1) != substr(b, 1, at_b - 1) || !near(number_a, number_b, share)) return 0
    a = substr(a, at_a + length(number_a))
    b = substr(b, at_b + length(number_b))
  }
  return a == b
}

# Runs the commands of a block; their output, errors as well, is what the next block of text shows.
function run(commands) {
  printf "%s", commands > (work "/.commands")
  close(work "/.commands")
  if (system("cd '" work "' && sh -eu .commands >.output 2>&1")) complain("a command fails:\n" lines_of(work "/.output"))
  output = lines_of(work "/.output")
  have_output = 1
}

# A block as it should be. @param language, argument the words behind the fence; marker, path what stands before it.
function right(block, language, argument, marker, path, source) {
  if (marker != "") {
    source = lines_of(root "/" path)
    if (marker == "file") return source
    if (!index(without_indent(source), without_indent(block))) complain("is not in " path ":\n" block)
  } else if (language == "sh") {
    run(block)
  } else if (language == "text") {
    if (!have_output) complain("a block of text, but no command before it")
    if (!alike(block, output, argument / 100)) return output
  } else if (language == "cpp" || language == "json") {
    complain("a block of " language " without <!-- file: PATH --> or <!-- from: PATH --> before it")
  }
  return block
}

# What `COMMAND --help` prints.
function help_of(command, call, line, text) {
  if (command in helps) return helps[command]
  call = command " --help 2>&1"
  while ((call | getline line) > 0) text = text line "\n"
  close(call)
  return helps[command] = text
}

# A command that is not run has at least a name and options that there are.
function check_options(text, words, command, i) {
  split(text, words, " ")
  command = "sklar"
  for (i = 2; i <= 3 && words[i] ~ /^[a-z]+$/; ++i) command = command " " words[i]
  if (!index(help_of(command), "Usage: " command " ")) complain("no command `" command "`")
  while (match(text, /--[a-z-]+/)) {
    if (!index(help_of(command), substr(text, RSTART, RLENGTH))) {
      complain("`" command "` has no option " substr(text, RSTART, RLENGTH))
    }
    text = substr(text, RSTART + RLENGTH)
  }
}

# The files that a line links to are there.
function check_links(text, folder, path) {
  folder = FILENAME
  sub(/[^\/]*$/, "", folder)
  while (match(text, /\]\([^)]+\)/)) {
    path = substr(text, RSTART + 2, RLENGTH - 3)
    text = substr(text, RSTART + RLENGTH)
    sub(/#.*/, "", path)
    if (path != "" && path !~ /:/ && system("test -e '" folder path "'")) complain("no file " path)
  }
}

BEGIN { kNumber = "-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?" }

inside && /^```/ {
  printf "%s%s\n", right(block, language, argument, marker, path), $0
  inside = 0
  marker = ""
  next
}
inside {
  block = block $0 "\n"
  next
}
{ opened = NR }
/^```/ {
  inside = 1
  language = substr($1, 4)
  argument = $2
  block = ""
}
/^<!-- (file|from): .* -->$/ {
  marker = substr($2, 1, 4)
  path = $3
}
/^    (build\/)?sklar / { check_options($0) }
{
  check_links($0)
  print
}
END { exit bad }
