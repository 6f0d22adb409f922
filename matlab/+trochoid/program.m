function answer = program(case_, varargin)
%PROGRAM  Forces on each tooth along a whole NC program in G code, with runout: which line
%   loads the tool most, and the feeds that keep your limits.
%
%   answer = trochoid.program(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('program', case_, varargin{:});
end
