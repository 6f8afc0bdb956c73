# Prints the first ```c block of a Markdown file, or with -v want=output the first line that the README shows as its output:
# a line of a later block that begins like what the program prints.
/^```/ {
    if (inside) { inside = 0; if (language == "c") done = 1 }
    else { inside = 1; language = substr($0, 4) }
    next
}
inside && language == "c" && !done && want != "output" { print }
inside && done && want == "output" && /^(walking|falling) at / { print; exit }
