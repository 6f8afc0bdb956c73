# Prints the first ```c block of a Markdown file; with -v block=2 the second one; with -v want=output the first line
# that the README shows as the first block's output: a line of a later block that begins like what the program prints.
BEGIN { if (!block) block = 1 }
/^```/ {
    if (inside) inside = 0
    else { inside = 1; language = substr($0, 4); if (language == "c") seen++ }
    next
}
inside && language == "c" && seen == block && want != "output" { print }
inside && language != "c" && seen && want == "output" && /^(walking|falling) at / { print; exit }
