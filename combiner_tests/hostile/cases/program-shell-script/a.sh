#!/bin/sh
echo a
for k in 1 2 3; do echo "$k"; done
