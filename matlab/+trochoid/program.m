function answer = program(case_, varargin)
%PROGRAM  The moves of a whole NC program in G code: every word is executed, known to be
%   without effect, or told with its line and column.
%
%   answer = trochoid.program(case_) of a case file, or of a struct of its tables.
%
%   See also trochoid.run, which says what the answer holds and which options there are.
answer = trochoid.run('program', case_, varargin{:});
end
